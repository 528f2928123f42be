// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/run/node_settings.hpp"

#include "host/opros/engine/node/node_adaptor.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"

#include <fmt/format.h>
#include <set>

namespace tandem::command {
namespace {

using engine::ConnectionProfile;
using engine::NodePart;

/// Returns HOST:PORT of a node that has an address.
std::string address_of(const NodePart& part, const std::string& node) {
    for (const engine::NodeAddress& each : part.application.nodes)
        if (each.id == node)
            return (each.host.find(':') == std::string::npos ? each.host : "[" + each.host + "]") + ":" +
                   std::to_string(each.port);
    return "";
}

std::string rtc_port(const NodePart& part, const engine::PortReference& port) {
    return "rtcloc://" + address_of(part, part.nodes.at(port.component)) + "/" + port.text();
}

/// The receiving node makes the connection.
std::string preconnect_entry(const NodePart& part, const ConnectionProfile& connection) {
    return rtc_port(part, connection.target) + "?port=" + rtc_port(part, connection.source) +
           (connection.newest_only ? "&subscription_type=new" : "");
}

/// Adds settings to those of an rtc.conf.
class SettingList {
  public:
    explicit SettingList(const std::filesystem::path& rtc_conf) {
        if (!rtc_conf.empty()) RTC::read_conf_file(rtc_conf, conf_);
    }
    /// Sets a value that the file does not have.
    void set_default(const std::string& key, const std::string& value) {
        if (conf_.getProperty(key).empty()) settings_.push_back(key + ":" + value);
    }
    /// Appends to the file's list.
    void append(const std::string& key, const std::string& value) {
        const std::string present = conf_.getProperty(key);
        settings_.push_back(key + ":" + present + (present.empty() ? "" : ",") + value);
    }
    bool has(const std::string& key, const std::string& text) const {
        return conf_.getProperty(key).find(text) != std::string::npos;
    }
    std::vector<std::string> take() && { return std::move(settings_); }

  private:
    coil::Properties conf_;
    std::vector<std::string> settings_;
};

} // namespace

std::vector<std::string> node_settings(const NodePart& part, const std::filesystem::path& rtc_conf) {
    std::vector<std::string> entries;
    std::set<std::string> peers;
    for (const ConnectionProfile& connection : part.crossing) {
        if (!connection.error.empty()) continue;
        const bool receives = part.nodes.at(connection.target.component) == part.node;
        peers.insert(part.nodes.at((receives ? connection.source : connection.target).component));
        if (receives) entries.push_back(preconnect_entry(part, connection));
    }
    if (peers.empty()) return {};
    std::vector<std::string> hosts;
    for (const engine::NodeAddress& each : part.application.nodes)
        if (peers.count(each.id) != 0) hosts.push_back(each.host);
    SettingList settings(rtc_conf);
    settings.set_default("corba.endpoints", address_of(part, part.node));
    settings.set_default("corba.permitted_hosts", fmt::format("{}", fmt::join(hosts, ",")));
    settings.set_default("naming.enable", "NO");
    settings.set_default("manager.shutdown_auto", "NO");
    settings.set_default("manager.shutdown_on_nortcs", "NO");
    constexpr const char* module = "InterceptorComp.so";
    if (!settings.has("manager.modules.preload", module)) settings.append("manager.modules.preload", module);
    settings.append("manager.components.precreate", "InterceptorComp?link=" + engine::node_link(part));
    if (!entries.empty())
        settings.append("manager.components.preconnect", fmt::format("{}", fmt::join(entries, ",")));
    return std::move(settings).take();
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/rtm_setup.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/running/conf.hpp"
#include "apps/tandem/system/running_system.hpp"
#include "host/text/printable.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Returns whether an entry of a list in rtc.conf can have a text. Names are those of other programs, and one with a
/// newline would be another setting.
bool is_plain(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return c > ' ' && c != 0x7f &&
               std::string_view(",&?#()\"\\").find(static_cast<char>(c)) == std::string_view::npos;
    });
}

/// Returns whether a property of a connection is one that its creator has chosen.
bool is_chosen(const std::string& key) {
    static const std::set<std::string> single{"dataflow_type", "subscription_type", "interface_type",
                                              "push_policy",   "push_rate",         "skip_count"};
    if (single.contains(key)) return true;
    for (const char* const side : {"inport.", "outport."})
        if (key.starts_with(side)) return is_chosen(key.substr(std::strlen(side)));
    for (const char* const prefix : {"buffer.length", "buffer.write.", "buffer.read.", "publisher."})
        if (key.starts_with(prefix)) return true;
    return false;
}

/// Changes a set-up to what runs.
class Snapshot {
  public:
    Snapshot(RtmSetup& setup, const ComponentSource& source) : setup_(setup), source_(source) {}

    std::vector<std::string> take() {
        const json components = describe_components(source_);
        for (const auto& entry : source_.components) present_.insert(entry.instance);
        std::erase_if(setup_.connections, [](const std::string& entry) {
            return entry.find("://") == std::string::npos || entry.find("://unix:self/") != std::string::npos;
        });
        std::erase_if(setup_.activations,
                      [](const std::string& entry) { return entry.find("://") == std::string::npos; });
        for (const json& component : components)
            for (const json& port : component["ports"])
                for (const json& connection : port["connections"]) take_connection(port, connection);
        for (const auto& entry : source_.components)
            if (setup_.creates(entry.instance)) take_component(entry);
        return std::move(left_out_);
    }

  private:
    // A connection is listed by each of its ports. The component of the sender, or of the first port, has it.
    void take_connection(const json& port, const json& connection) {
        const std::string id = connection["id"], from = port["name"];
        const std::string to = connection["with"].size() == 1 ? connection["with"][0].get<std::string>() : "";
        if (port["kind"] == "DataInPort" && present_.contains(component_of(to)))
            return; // the OutPort lists it
        if (!seen_.insert(id).second) return;
        std::string entry = name_of(from) + "?port=" + name_of(to);
        bool plain = is_plain(name_of(from)) && is_plain(name_of(to));
        for (const auto& [key, value] : connection["properties"].items()) {
            const std::string name = key.substr(key.find('.') + 1), text = value.get<std::string>();
            if (!is_chosen(name) || text.empty()) continue;
            plain = plain && is_plain(text);
            entry += "&" + name + "=" + text;
        }
        if (plain && present_.contains(component_of(to)))
            setup_.connections.push_back(entry);
        else if (!is_kept(from))
            left_out_.push_back("connection of " + from + " with " + (to.empty() ? "other ports" : to));
    }

    static std::string component_of(const std::string& port) { return port.substr(0, port.rfind('.')); }

    // The RTC of an OPRoS component appears after the connections are made.
    std::string name_of(const std::string& port) const {
        return (setup_.creates(component_of(port)) ? "" : "rtcloc://unix:self/") + port;
    }

    // An entry of the previous rtc.conf connects the port with another process.
    bool is_kept(const std::string& port) const {
        return std::any_of(
            setup_.connections.begin(), setup_.connections.end(), [&](const std::string& entry) {
                return entry.find("://") != std::string::npos && entry.find(port) != std::string::npos;
            });
    }

    void take_component(const ComponentEntry& entry) {
        if (!entry.error.empty())
            return left_out_.push_back("settings of " + entry.instance + ": " + entry.error);
        if (entry.type == "InterceptorComp") return;
        if (entry.state == "ACTIVE" && is_plain(entry.instance)) setup_.activations.push_back(entry.instance);
        const std::string prefix = entry.category + "." + entry.instance + ".";
        const json sets = call_remote(entry.address, [&] {
            SDOPackage::Configuration_var configuration = entry.object->get_configuration();
            return sets_json(configuration.in());
        });
        for (const json& set : sets) {
            const std::string name = set["set"];
            if (set["active"] == true && name != "default") put(prefix + "configuration.active_config", name);
            for (const auto& [key, value] : set["values"].items())
                put(prefix + "conf." + name + "." + key, value.get<std::string>());
        }
    }

    void put(const std::string& key, const std::string& value) {
        std::erase_if(setup_.settings, [&](const auto& setting) { return setting.key == key; });
        if (!is_plain(key) || text::printable_line(value) != value)
            return left_out_.push_back("setting " + text::printable_line(key));
        if (!value.empty()) setup_.settings.push_back({key, value, ""});
    }

    RtmSetup& setup_;
    const ComponentSource& source_;
    std::set<std::string> present_, seen_;
    std::vector<std::string> left_out_;
};

} // namespace

std::vector<std::string> save_rtm(const RunningSystem& system, const fs::path& output) {
    RtmSetup setup;
    setup.installation = system.rtc_conf.parent_path();
    setup.conf = system.rtc_conf;
    setup.output = output / "rtm";
    ImportReport report; // what an import says, the host has said when it started
    read_rtc_conf(setup, report);
    RtmClientOptions options;
    options.managers = {fmt::format("unix:{}", system.rtm)};
    const RtmClient client(options);
    const auto sources = enumerate_components(client);
    throw_if_sources_failed(client, sources);
    auto left_out = Snapshot(setup, sources.front()).take();
    write_file(setup.output / "rtc.conf", setup.text("tandem system save"));
    copy_settings_files(setup, report);
    return left_out;
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shared_ports/link_ports.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"

namespace tandem::command {

std::optional<LinkPorts> LinkPortFinder::find(const std::string& link) {
    if (auto table = read_shared_ports(link)) return LinkPorts{std::move(*table), true};
    const auto& tables = configured();
    const auto found = tables.find(link);
    if (found == tables.end()) return std::nullopt;
    return LinkPorts{found->second, false};
}

std::map<std::string, std::string> LinkPortFinder::configured_links() {
    std::map<std::string, std::string> links;
    for (const auto& [link, table] : configured()) links.emplace(link, table.component_names());
    return links;
}

const std::map<std::string, link::PortTable>& LinkPortFinder::configured() {
    if (!configured_)
        configured_ =
            conf_.empty() ? std::map<std::string, link::PortTable>() : probe_rtc_conf(conf_, options_);
    return *configured_;
}

std::filesystem::path peer_rtc_conf(const std::filesystem::path& application) {
    const auto folder = std::filesystem::absolute(application).lexically_normal().parent_path();
    auto conf = folder.parent_path() / "rtm" / "rtc.conf";
    return folder.filename() == "opros" && is_there(conf) ? conf : std::filesystem::path();
}

} // namespace tandem::command

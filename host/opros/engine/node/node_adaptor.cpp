// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/node/node_adaptor.hpp"

#include "host/text/join.hpp"
#include "host/text/split_names.hpp"
#include "shm/os/link_name.hpp"

#include <fmt/format.h>
#include <map>
#include <set>

namespace tandem::engine {
namespace {

constexpr const char* adaptor_name = "NodeAdaptor";

bool is_here(const NodePart& part, const std::string& component) {
    return part.nodes.at(component) == part.node;
}

std::set<std::string> components_to_share(const NodePart& part) {
    std::set<std::string> names;
    for (const ConnectionProfile& connection : part.crossing)
        for (const auto& name : {connection.source.component, connection.target.component})
            if (connection.error.empty() && is_here(part, name)) names.insert(name);
    for (const Subcomponent& component : part.application.subcomponents)
        for (const auto& [name, value] : component.properties) {
            if (name != "share") continue;
            for (const std::string& shared : text::split_names(value)) names.erase(shared);
        }
    return names;
}

/// Returns AdaptorComp's property `interfaces`, so that the RTM side of both nodes gives the two ports of a connection one
/// type: of a service, the name of the provided port; of messages, one that depends on their members only.
std::string interfaces(const NodePart& part) {
    std::map<std::string, std::string> names;
    for (const ConnectionProfile& connection : part.crossing) {
        if (!connection.error.empty()) continue;
        if (connection.type != OPROS_SERVICE) {
            const bool sends = is_here(part, connection.source.component);
            names[(sends ? connection.source : connection.target).text()] = "OPRoS::message";
        } else if (is_here(part, connection.source.component)) {
            names[connection.source.text()] = connection.target.port + "." + connection.target.port;
        }
    }
    return text::join(names, ", ", [](const auto& each) { return each.first + "=" + each.second; });
}

} // namespace

std::string node_link(const NodePart& part) {
    constexpr std::size_t max_node = 32;
    const std::string node = "-" + part.node.substr(0, max_node);
    // The application's name is what is cut: two nodes on one machine need two links.
    return shm::as_link_name(part.application.name.substr(0, shm::max_link_name - node.size()) + node);
}

void add_node_adaptor(NodePart& part, const std::vector<std::filesystem::path>& plugin_dirs) {
    const auto shared = components_to_share(part);
    if (shared.empty()) return;
    for (const Subcomponent& component : part.application.subcomponents)
        if (component.name == adaptor_name)
            throw SetupError(component.location,
                             std::string("component '") + adaptor_name +
                                 "' has the name of the AdaptorComp that connects the nodes, expected "
                                 "another name");
    Subcomponent adaptor{part.application.location,
                         adaptor_name,
                         "AdaptorComp.xml",
                         {{"link", node_link(part)},
                          {"share", fmt::format("{}", fmt::join(shared, ", "))},
                          {"interfaces", interfaces(part)}},
                         {}};
    adaptor.file = find_component_profile(part.application, adaptor, plugin_dirs);
    part.application.subcomponents.push_back(std::move(adaptor));
}

} // namespace tandem::engine

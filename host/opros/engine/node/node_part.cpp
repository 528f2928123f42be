// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/node/node_part.hpp"

#include "host/opros/engine/profile/flatten_composites.hpp"

#include <fmt/format.h>
#include <set>

namespace tandem::engine {
namespace {

std::set<std::string> node_ids(const ApplicationProfile& application) {
    std::set<std::string> ids;
    for (const Subcomponent& component : application.subcomponents)
        if (!component.node.empty()) ids.insert(component.node);
    return ids;
}

std::string choose_node(const ApplicationProfile& application, const std::string& requested) {
    std::set<std::string> ids = node_ids(application);
    if (requested.empty() && application.local_node.empty()) {
        if (ids.size() > 1)
            throw SetupError(
                application.location,
                fmt::format("the components run on several nodes ({}), expected a choice of one: "
                            "start this machine's part with --node ID, or add "
                            "<local_node_id>ID</local_node_id>",
                            fmt::join(ids, ", ")));
        return ids.empty() ? "" : *ids.begin();
    }
    for (const NodeAddress& node : application.nodes) ids.insert(node.id);
    const std::string& chosen = requested.empty() ? application.local_node : requested;
    if (ids.count(chosen) != 0) return chosen;
    throw SetupError(application.location,
                     (requested.empty() ? "<local_node_id> is '" : "--node is '") + chosen + "', expected " +
                         (ids.empty() ? "none, because no component has a <node_id>"
                                      : fmt::format("one of {}", fmt::join(ids, ", "))));
}

/// Sorts an application's parts by whether they are on the node.
class NodeFilter {
  public:
    NodeFilter(ApplicationProfile application, std::string node) : whole_(std::move(application)) {
        part_.node = std::move(node);
        for (const Subcomponent& component : whole_.subcomponents) nodes_[component.name] = component.node;
    }

    NodePart take_part() && {
        std::vector<Subcomponent> components;
        for (Subcomponent& component : whole_.subcomponents)
            if (!is_elsewhere(component.name)) components.push_back(std::move(component));
        for (const Subcomponent& component : components)
            if (!component.missing_profile.empty()) throw SetupError(component.missing_profile);
        if (components.empty())
            throw SetupError(whole_.location,
                             "node '" + part_.node + "' has no component, expected one with its <node_id>");
        whole_.subcomponents = std::move(components);
        filter_connections();
        filter_dependencies();
        part_.application = std::move(whole_);
        return std::move(part_);
    }

  private:
    bool is_elsewhere(const std::string& component) const {
        const auto found = nodes_.find(component);
        return found != nodes_.end() && !found->second.empty() && found->second != part_.node;
    }

    /// A component without a node is on every node, so its connections stay within each of them.
    bool is_only_here(const std::string& component) const {
        const auto found = nodes_.find(component);
        return found != nodes_.end() && found->second == part_.node;
    }

    /// Returns why a node cannot be reached, or an empty string.
    std::string address_error(const std::string& node) const {
        for (const NodeAddress& each : whole_.nodes)
            if (each.id == node) return "";
        return "node '" + node + "' has no address, expected it in <node_map>";
    }

    /// The names become parts of lists and addresses in the settings of AdaptorComp and rtm_host.
    static std::string name_error(const PortReference& port) {
        for (const std::string& name : {port.component, port.port})
            if (name.find_first_of(" \t\r\n,;:?&=/()%\"'\\") != std::string::npos)
                return "'" + name +
                       "' is connected with another node, expected a name without blanks and ,;:?&=/()%\"'\\";
        return "";
    }

    void filter_connections() {
        std::vector<ConnectionProfile> local;
        for (ConnectionProfile& connection : whole_.connections) {
            const std::string &source = connection.source.component, &target = connection.target.component;
            const bool leaves = is_elsewhere(source) || is_elsewhere(target);
            if (!leaves) {
                local.push_back(std::move(connection));
            } else if (is_only_here(source) || is_only_here(target)) {
                for (const PortReference& port : {connection.source, connection.target}) {
                    part_.nodes[port.component] = nodes_[port.component];
                    if (connection.error.empty()) connection.error = address_error(nodes_[port.component]);
                    if (connection.error.empty()) connection.error = name_error(port);
                }
                part_.crossing.push_back(std::move(connection));
            }
        }
        whole_.connections = std::move(local);
    }

    void filter_dependencies() {
        std::vector<Dependency> local;
        for (const Dependency& dependency : whole_.dependencies) {
            const bool source = is_elsewhere(dependency.source), target = is_elsewhere(dependency.target);
            if (!source && !target) local.push_back(dependency);
            if (!source && target)
                part_.notices.push_back(dependency.location.text() + ": component '" + dependency.source +
                                        "' does not wait for '" + dependency.target + "' of node '" +
                                        nodes_[dependency.target] +
                                        "': <depends> applies only within a node");
        }
        whole_.dependencies = std::move(local);
    }

    ApplicationProfile whole_;
    std::map<std::string, std::string> nodes_; ///< by component
    NodePart part_;
};

} // namespace

NodePart node_part(ApplicationProfile application, const std::string& node) {
    std::string chosen = choose_node(application, node);
    return NodeFilter(std::move(application), std::move(chosen)).take_part();
}

ApplicationProfile local_application(ApplicationProfile application,
                                     const std::vector<std::filesystem::path>& plugin_dirs,
                                     const std::string& node) {
    if (has_composites(application, plugin_dirs)) application = flatten_composites(application, plugin_dirs);
    const bool is_whole = node.empty() && application.local_node.empty();
    return is_whole ? application : node_part(std::move(application), node).application;
}

} // namespace tandem::engine

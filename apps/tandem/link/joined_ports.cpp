// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/joined_ports.hpp"

#include "apps/tandem/link/port_pairs.hpp"
#include "apps/tandem/opros/peer_ports.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/shared_ports/link_ports.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "proxy/adaptor/property_check.hpp"

#include <algorithm>
#include <set>

namespace tandem::command {
namespace {

constexpr std::size_t max_trials =
    2000; // limit for large components; a trial takes microseconds to milliseconds

/// Collects the results, component by component.
class Collector {
  public:
    Collector(const RunFolder& folder, const InspectOptions& options)
        : options_(options), finder_(folder.rtc_conf, {options.plugin_dirs, options.timeout_s}) {
        options_.file = folder.application;
        joined_.application = engine::read_application_profile(folder.application);
        if (engine::has_composites(joined_.application, options.plugin_dirs))
            joined_.application = engine::flatten_composites(joined_.application, options.plugin_dirs);
    }

    JoinedPorts collect() {
        for (const auto& entry : joined_.application.subcomponents) {
            try {
                add(entry);
            } catch (const std::runtime_error& error) {
                joined_.errors.emplace_back(error.what());
            }
        }
        note_links_without_adaptor();
        try_connections();
        return std::move(joined_);
    }

  private:
    void add(const engine::Subcomponent& entry) {
        auto dirs = options_.plugin_dirs;
        dirs.insert(dirs.begin(), options_.file.parent_path());
        const auto file = entry.file.empty()
                              ? engine::find_component_profile(joined_.application, entry, dirs)
                              : entry.file;
        const auto profile = engine::read_component_profile(file);
        const auto library = engine::find_component_library(profile, dirs);
        if (is_adaptor(library))
            return add_adaptor(entry, adaptor_link(entry, profile), adaptor_properties(entry, profile));
        engine::require_opros_component(library);
        joined_.components[entry.name] = {
            entry, describe_in_child(library, file, options_)["ports"], "", "", false, {}};
    }

    void add_adaptor(const engine::Subcomponent& entry, const std::string& link,
                     std::map<std::string, std::string> properties) {
        joined_links_.push_back(link);
        const auto shared = finder_.find(link);
        if (!shared) {
            std::string named;
            for (const auto& [other, rtc] : finder_.configured_links())
                named += (named.empty() ? "" : ", ") + other;
            throw engine::SetupError(
                entry.location,
                "component '" + entry.name + "' joins link '" + link +
                    "', but no InterceptorComp in rtc.conf has this link (links in rtc.conf: " +
                    (named.empty() ? "none" : named) + ")");
        }
        std::vector<std::string> names;
        names.reserve(properties.size());
        for (const auto& [name, value] : properties) names.push_back(name);
        auto lines = adaptor::find_properties_without_port(names, shared->table);
        for (auto& line : adaptor::find_unknown_properties(names)) lines.push_back(std::move(line));
        for (const auto& line : lines) joined_.errors.push_back("component '" + entry.name + "': " + line);
        tables_[entry.name] = link::encode_as_text(shared->table);
        joined_.components[entry.name] = {entry,
                                          describe_mirrors(shared->table, event_ports(properties)),
                                          link,
                                          shared->table.component_names(),
                                          shared->running,
                                          std::move(properties)};
    }

    void note_links_without_adaptor() {
        try {
            for (const auto& [link, rtc] : finder_.configured_links())
                if (std::find(joined_links_.begin(), joined_links_.end(), link) == joined_links_.end())
                    joined_.errors.push_back(finder_.conf().string() + ": InterceptorComp shares " + rtc +
                                             " on link '" + link +
                                             "', but no AdaptorComp of the application joins it");
        } catch (const std::runtime_error& error) {
            // The hosts may be running even if the probe fails, for example because a device is in use.
            if (tables_.empty()) joined_.errors.emplace_back(error.what());
        }
    }

    /// Tries the application's connections, and possible connections between unconnected ports.
    void try_connections() {
        std::vector<TrialConnection> trials;
        auto& errors = joined_.connection_errors;
        for (const auto& connection : joined_.application.connections) {
            errors.push_back(connection.error);
            if (is_known(connection))
                trials.push_back({connection.type, connection.source, connection.target});
        }
        const std::size_t own = trials.size();
        add_suggestions(trials);
        std::vector<std::string> excluded;
        for (const auto& entry : joined_.application.subcomponents)
            if (joined_.components.count(entry.name) == 0) excluded.push_back(entry.name);
        const auto found = try_connections_in_child(trials, excluded, tables_, options_);
        std::size_t next = 0;
        for (std::size_t i = 0; i < errors.size(); ++i)
            if (is_known(joined_.application.connections[i])) errors[i] = found.at(next++);
        for (std::size_t i = own; i < trials.size(); ++i) {
            if (!found.at(i).empty()) continue;
            joined_.suggestions[trials[i].source.text()].push_back(trials[i].target);
            joined_.suggestions[trials[i].target.text()].push_back(trials[i].source);
        }
    }

    void add_suggestions(std::vector<TrialConnection>& trials) const {
        std::set<std::string> connected;
        for (const auto& connection : joined_.application.connections)
            connected.insert({connection.source.text(), connection.target.text()});
        const auto free_ports = [&](const JoinedComponent& component) {
            nlohmann::json ports = nlohmann::json::array();
            for (const auto& port : component.ports)
                if (connected.count(component.entry.name + "." + port["name"].get<std::string>()) == 0)
                    ports.push_back(port);
            return ports;
        };
        for (const auto& [adaptor_name, adaptor] : joined_.components)
            for (const auto& [name, component] : joined_.components) {
                if (adaptor.link.empty() || !component.link.empty()) continue;
                for (const auto& pair : possible_pairs(free_ports(component), free_ports(adaptor))) {
                    if (trials.size() >= max_trials) return;
                    engine::PortReference opros{name, pair.opros["name"]},
                        rtc{adaptor_name, pair.rtc["name"]};
                    if (!pair.from_opros()) std::swap(opros, rtc);
                    trials.push_back({port_type(pair.opros), opros, rtc});
                }
            }
    }

    bool is_known(const engine::ConnectionProfile& connection) const {
        return connection.error.empty() && joined_.components.count(connection.source.component) != 0 &&
               joined_.components.count(connection.target.component) != 0;
    }

    InspectOptions options_;
    LinkPortFinder finder_;
    JoinedPorts joined_;
    std::vector<std::string> joined_links_;
    std::map<std::string, std::string> tables_; ///< of each AdaptorComp, for the child process
};

} // namespace

JoinedPorts find_joined_ports(const RunFolder& folder, const InspectOptions& options) {
    return Collector(folder, options).collect();
}

} // namespace tandem::command

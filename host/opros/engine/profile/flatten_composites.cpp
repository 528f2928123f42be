// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/flatten_composites.hpp"

#include "host/opros/engine/profile/duplicate_connections.hpp"
#include "host/opros/engine/profile/port_type.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <algorithm>
#include <map>

namespace tandem::engine {
namespace {

/// Nested composites multiply: ten levels of ten are 10^10 components.
constexpr std::size_t max_components = 1000;

/// Builds the flat application depth first. Connections are collected with the names of composites and resolved at
/// the end, when the exports of all composites are known.
class CompositeFlattener {
  public:
    CompositeFlattener(const ApplicationProfile& application, const std::vector<std::filesystem::path>& dirs)
        : plugin_dirs_(dirs) {
        flat_.location = application.location;
        flat_.name = application.name;
        flat_.local_node = application.local_node;
        flat_.nodes = application.nodes;
        flat_.structure_errors = application.structure_errors;
        add_assembly(application, "", "");
        for (ConnectionProfile& connection : flat_.connections) {
            resolve_exported_port(connection, connection.source);
            resolve_exported_port(connection, connection.target);
        }
        // The reader has marked duplicates already, but two exported names may stand for the same port.
        mark_duplicate_connections(flat_.connections);
    }
    ApplicationProfile take_result() && { return std::move(flat_); }

  private:
    struct Composite {
        std::vector<ExportedPort> exports;
        std::vector<std::string> members; ///< its components at all depths, without nested composites
    };

    /// Adds an application or a composite. `prefix` precedes its components' names. `node` is the node of its
    /// components that name none.
    void add_assembly(const ApplicationProfile& assembly, const std::string& prefix,
                      const std::string& node) {
        enclosing_files_.push_back(std::filesystem::canonical(assembly.location.file));
        for (Subcomponent entry : assembly.subcomponents) {
            if (entry.node.empty()) entry.node = node;
            add_subcomponent(assembly, std::move(entry), prefix);
        }
        enclosing_files_.pop_back();
        for (ConnectionProfile connection : assembly.connections) {
            connection.source.component.insert(0, prefix);
            connection.target.component.insert(0, prefix);
            flat_.connections.push_back(std::move(connection));
        }
        for (const Dependency& dependency : assembly.dependencies)
            for (const std::string& source : members_of(prefix + dependency.source))
                for (const std::string& target : members_of(prefix + dependency.target))
                    flat_.dependencies.push_back({dependency.location, source, target});
    }

    void add_subcomponent(const ApplicationProfile& assembly, Subcomponent entry, const std::string& prefix) {
        find_profile(assembly, entry);
        entry.name.insert(0, prefix);
        if (!entry.file.empty() && read_profile_kind(entry.file) == ProfileKind::composite)
            return add_composite(entry);
        if (flat_.subcomponents.size() == max_components)
            throw SetupError(entry.location, "the application has more than " +
                                                 std::to_string(max_components) +
                                                 " components with those of its composites");
        flat_.subcomponents.push_back(std::move(entry));
    }

    void find_profile(const ApplicationProfile& assembly, Subcomponent& entry) {
        try {
            entry.file = find_component_profile(assembly, entry, plugin_dirs_);
        } catch (const SetupError& error) {
            if (entry.node.empty()) throw;
            entry.missing_profile = error.what();
        }
    }

    void add_composite(const Subcomponent& entry) {
        // Compares canonical paths: one file may be reached under several names.
        const auto file = std::filesystem::canonical(entry.file);
        if (std::find(enclosing_files_.begin(), enclosing_files_.end(), file) != enclosing_files_.end())
            throw SetupError(entry.location, "composite " + entry.file.string() + " contains itself");
        if (!entry.properties.empty())
            throw SetupError(entry.location, "composite '" + entry.name +
                                                 "' cannot have properties; give them to its components in " +
                                                 entry.file.string());
        ApplicationProfile composite = read_composite_profile(entry.file);
        const std::size_t first_member = flat_.subcomponents.size();
        add_assembly(composite, entry.name + ".", entry.node);
        flat_.structure_errors.insert(flat_.structure_errors.end(), composite.structure_errors.begin(),
                                      composite.structure_errors.end());
        Composite& added = composites_[entry.name];
        added.exports = std::move(composite.exports);
        for (std::size_t i = first_member; i < flat_.subcomponents.size(); ++i)
            added.members.push_back(flat_.subcomponents[i].name);
    }

    /// Returns the components of the composite with this name, or the name itself if it is a component.
    std::vector<std::string> members_of(const std::string& name) const {
        const auto found = composites_.find(name);
        return found == composites_.end() ? std::vector<std::string>{name} : found->second.members;
    }

    /// Replaces an exported port of a composite by the component's port. Loops, because a composite may export what
    /// an inner composite exports.
    void resolve_exported_port(ConnectionProfile& connection, PortReference& port) const {
        for (auto found = composites_.find(port.component);
             connection.error.empty() && found != composites_.end();
             found = composites_.find(port.component)) {
            const PortReference* inner = find_export(found->second, connection.type, port.port);
            if (inner)
                port = {port.component + "." + inner->component, inner->port};
            else
                connection.error = missing_export_error(found->second, connection.type, port);
        }
    }

    static const PortReference* find_export(const Composite& composite, PortType type,
                                            const std::string& name) {
        for (const ExportedPort& each : composite.exports)
            if (each.type == type && each.name == name) return &each.port;
        return nullptr;
    }

    static std::string missing_export_error(const Composite& composite, PortType type,
                                            const PortReference& port) {
        const std::string kind = port_type_name(type);
        std::string known;
        for (const ExportedPort& each : composite.exports)
            if (each.type == type) known += (known.empty() ? "" : ", ") + each.name;
        return "composite '" + port.component + "' exports no " + kind + " port '" + port.port + "', its " +
               kind + " ports are: " + (known.empty() ? "none" : known);
    }

    const std::vector<std::filesystem::path>& plugin_dirs_;
    ApplicationProfile flat_;
    std::map<std::string, Composite> composites_; // key: name in the flat application
    std::vector<std::filesystem::path>
        enclosing_files_; // of the assemblies that are being added, outermost first
};

} // namespace

ApplicationProfile flatten_composites(const ApplicationProfile& application,
                                      const std::vector<std::filesystem::path>& plugin_dirs) {
    return CompositeFlattener(application, plugin_dirs).take_result();
}

bool has_composites(const ApplicationProfile& application,
                    const std::vector<std::filesystem::path>& plugin_dirs) {
    const auto is_composite = [&](const Subcomponent& entry) {
        try {
            return read_profile_kind(find_component_profile(application, entry, plugin_dirs)) ==
                   ProfileKind::composite;
        } catch (const SetupError&) { // reported when the profile itself is needed
            return false;
        }
    };
    return std::any_of(application.subcomponents.begin(), application.subcomponents.end(), is_composite);
}

} // namespace tandem::engine

// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/flatten_composites.hpp"

#include "host/opros/engine/profile/duplicate_connections.hpp"

#include <algorithm>
#include <map>

namespace tandem::engine {
namespace {

constexpr std::size_t max_components = 1000; // composites of composites grow fast

class Expansion {
  public:
    Expansion(const ApplicationProfile& application, const std::vector<std::filesystem::path>& dirs)
        : dirs_(dirs) {
        flat_.location = application.location;
        flat_.name = application.name;
        add(application, "");
        for (ConnectionProfile& connection : flat_.connections) {
            behind(connection, connection.source);
            behind(connection, connection.target);
        }
        mark_duplicate_connections(flat_.connections); // a port may be exported under two names
    }
    ApplicationProfile result() && { return std::move(flat_); }

  private:
    struct Composite {
        std::vector<ExportedPort> exports;
        std::vector<std::string> members; ///< of all depths, no composites
    };

    void add(const ApplicationProfile& assembly, const std::string& prefix) {
        open_.push_back(std::filesystem::canonical(assembly.location.file));
        for (const Subcomponent& entry : assembly.subcomponents) add_one(assembly, entry, prefix);
        open_.pop_back();
        for (ConnectionProfile connection : assembly.connections) {
            connection.source.component.insert(0, prefix);
            connection.target.component.insert(0, prefix);
            flat_.connections.push_back(std::move(connection));
        }
        for (const Dependency& dependency : assembly.dependencies)
            for (const std::string& source : members(prefix + dependency.source))
                for (const std::string& target : members(prefix + dependency.target))
                    flat_.dependencies.push_back({dependency.location, source, target});
    }

    void add_one(const ApplicationProfile& assembly, Subcomponent entry, const std::string& prefix) {
        entry.file = find_component_profile(assembly, entry, dirs_);
        entry.name.insert(0, prefix);
        if (read_profile_kind(entry.file) == ProfileKind::composite) return add_composite(entry);
        if (flat_.subcomponents.size() == max_components)
            throw SetupError(entry.location, "the application has more than " +
                                                 std::to_string(max_components) +
                                                 " components with those of its composites");
        flat_.subcomponents.push_back(std::move(entry));
    }

    void add_composite(const Subcomponent& entry) {
        if (std::find(open_.begin(), open_.end(), std::filesystem::canonical(entry.file)) != open_.end())
            throw SetupError(entry.location, "composite " + entry.file.string() + " contains itself");
        if (!entry.properties.empty())
            throw SetupError(entry.location,
                             "composite '" + entry.name +
                                 "' has no properties of its own, give them to its components in " +
                                 entry.file.string());
        ApplicationProfile composite = read_composite_profile(entry.file);
        const std::size_t first = flat_.subcomponents.size();
        add(composite, entry.name + ".");
        Composite& added = composites_[entry.name];
        added.exports = std::move(composite.exports);
        for (std::size_t i = first; i < flat_.subcomponents.size(); ++i)
            added.members.push_back(flat_.subcomponents[i].name);
    }

    std::vector<std::string> members(const std::string& name) const {
        const auto found = composites_.find(name);
        return found == composites_.end() ? std::vector<std::string>{name} : found->second.members;
    }

    /// Goes from an exported port to the component's own.
    void behind(ConnectionProfile& connection, PortReference& port) const {
        for (auto found = composites_.find(port.component);
             connection.error.empty() && found != composites_.end();
             found = composites_.find(port.component)) {
            const PortReference* inner = exported(found->second, connection.type, port.port);
            if (inner)
                port = {port.component + "." + inner->component, inner->port};
            else
                connection.error = not_exported(found->second, connection.type, port);
        }
    }

    static const PortReference* exported(const Composite& composite, PortType type, const std::string& name) {
        for (const ExportedPort& each : composite.exports)
            if (each.type == type && each.name == name) return &each.port;
        return nullptr;
    }

    static std::string not_exported(const Composite& composite, PortType type, const PortReference& port) {
        const std::string kind = type == OPROS_DATA ? "data" : type == OPROS_EVENT ? "event" : "service";
        std::string known;
        for (const ExportedPort& each : composite.exports)
            if (each.type == type) known += (known.empty() ? "" : ", ") + each.name;
        return "composite '" + port.component + "' exports no " + kind + " port '" + port.port + "', its " +
               kind + " ports are: " + (known.empty() ? "none" : known);
    }

    const std::vector<std::filesystem::path>& dirs_;
    ApplicationProfile flat_;
    std::map<std::string, Composite> composites_;
    std::vector<std::filesystem::path> open_; // those that we are in
};

} // namespace

ApplicationProfile flatten_composites(const ApplicationProfile& application,
                                      const std::vector<std::filesystem::path>& plugin_dirs) {
    return Expansion(application, plugin_dirs).result();
}

bool has_composites(const ApplicationProfile& application,
                    const std::vector<std::filesystem::path>& plugin_dirs) {
    const auto is_composite = [&](const Subcomponent& entry) {
        try {
            return read_profile_kind(find_component_profile(application, entry, plugin_dirs)) ==
                   ProfileKind::composite;
        } catch (const SetupError&) { // told by whoever needs the profile
            return false;
        }
    };
    return std::any_of(application.subcomponents.begin(), application.subcomponents.end(), is_composite);
}

} // namespace tandem::engine

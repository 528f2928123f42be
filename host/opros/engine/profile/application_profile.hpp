// SPDX-License-Identifier: Apache-2.0
// Application profiles (<package_profile>, <application_profile>) and composite profiles
// (<composite_component_profile>): both list components and the connections between them.
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

namespace tandem::engine {

/// One component of an application: its unique name and its profile.
struct Subcomponent {
    SourceLocation location;
    std::string name, reference; ///< reference: file name of the profile, as written in the application
    Properties properties;       ///< override the properties of the component profile
    std::filesystem::path file;  ///< the profile; empty until find_component_profile() has found it
    std::string node{};          ///< <node_id>: the machine that runs the component; empty: every node
    /// Why flatten_composites() has not found the profile. Only for components with a node: another machine may have it.
    std::string missing_profile{};
};

struct PortReference {
    std::string component, port;
    std::string text() const { return component + "." + port; }
};

/// A connection as listed in the profile: from an output or required port to an input or provided port.
struct ConnectionProfile {
    SourceLocation location;
    PortType type = OPROS_DATA;
    PortReference source, target;
    /// Why the connection cannot be made, as far as the profiles show; otherwise empty. Such a connection stays in
    /// the list, because the rest of the application may run without it.
    std::string error;
    bool newest_only = false; ///< between nodes: a message that waits is replaced by the next one
};

/// <depends>: each cycle of `source` waits for a cycle of `target`, and `target` starts first.
struct Dependency {
    SourceLocation location;
    std::string source, target;
};

/// A port of a composite, with the name that other components connect to. `port` is the port inside the composite.
struct ExportedPort {
    SourceLocation location;
    std::string name;
    PortType type = OPROS_DATA;
    PortReference port;
};

/// An entry of <node_map>, as in the original engine's system.xml.
struct NodeAddress {
    SourceLocation location;
    std::string id, host; ///< host: an IP address
    int port = 0;
};

struct ApplicationProfile {
    SourceLocation location;
    std::string name;
    std::string local_node{}; ///< <local_node_id>: the node of this machine; empty: not chosen
    std::vector<NodeAddress> nodes{};
    std::vector<Subcomponent> subcomponents;
    std::vector<ConnectionProfile> connections;
    std::vector<Dependency> dependencies;
    std::vector<ExportedPort> exports;         ///< empty for an application
    std::vector<std::string> structure_errors; ///< from find_structure_errors(), with those of its composites
};

/// Read a profile. Throw SetupError if the file cannot be read, is not well-formed XML or not a profile of this kind,
/// or if an element is missing or wrong. A wrong connection does not throw: see ConnectionProfile::error.
ApplicationProfile read_application_profile(const std::filesystem::path& file);
ApplicationProfile read_application_profile(const XmlFile& xml);
ApplicationProfile read_composite_profile(const std::filesystem::path& file);
ApplicationProfile read_composite_profile(const XmlFile& xml);

/// Returns the file of a subcomponent's profile. Looks in a folder named after the component, in its `profile/`, in a
/// folder named after the application's file, beside the application profile, and in the plugin folders, in this
/// order. If the file is nowhere, a file of that name in another case counts. Throws SetupError with the searched paths.
std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine

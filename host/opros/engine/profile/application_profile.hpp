// SPDX-License-Identifier: Apache-2.0
// Application profiles (<package_profile>, <application_profile>) and composite profiles
// (<composite_component_profile>): both list components and the connections between them.
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

namespace tandem::engine {

/// One component of an application: a name that is unique in it, and the profile it is made from.
struct Subcomponent {
    SourceLocation location;
    std::string name, reference; ///< reference: the profile's file name, as the application gives it
    Properties properties;       ///< override those of the component profile
    std::filesystem::path file;  ///< the profile; empty until find_component_profile() has found it
};

struct PortReference {
    std::string component, port;
    std::string text() const { return component + "." + port; }
};

/// A connection as the profile lists it: from an output or required port to an input or provided one.
struct ConnectionProfile {
    SourceLocation location;
    PortType type = OPROS_DATA;
    PortReference source, target;
    /// Why it cannot be made, as far as the profiles alone tell; empty otherwise. Such a connection stays in
    /// the list, because the rest of the application may run without it.
    std::string error;
};

/// <depends>: each cycle of `source` waits for a cycle of `target`, and `target` starts first.
struct Dependency {
    SourceLocation location;
    std::string source, target;
};

/// A port of a composite, under the name that others connect to. `port` is the port of the composite's own
/// component that it stands for.
struct ExportedPort {
    SourceLocation location;
    std::string name;
    PortType type = OPROS_DATA;
    PortReference port;
};

struct ApplicationProfile {
    SourceLocation location;
    std::string name;
    std::vector<Subcomponent> subcomponents;
    std::vector<ConnectionProfile> connections;
    std::vector<Dependency> dependencies;
    std::vector<ExportedPort> exports; ///< of a composite; empty for an application
};

/// All throw SetupError: the file cannot be read, is not well-formed XML or not a profile of this kind, or an
/// element is missing or wrong. A wrong connection is no exception: see ConnectionProfile::error.
ApplicationProfile read_application_profile(const std::filesystem::path& file);
ApplicationProfile read_application_profile(const XmlFile& xml);
ApplicationProfile read_composite_profile(const std::filesystem::path& file);
ApplicationProfile read_composite_profile(const XmlFile& xml);

/// The file that a subcomponent's reference means: in a folder named after the component (or its `profile/`),
/// in a folder named after the application's file, beside the application profile, or in a plugin folder, in
/// this order. Throws SetupError that lists where it looked.
std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine

// SPDX-License-Identifier: Apache-2.0
// Application and component profiles as the engine uses them.
#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <OPRoSTypes.h>

namespace tandem::engine {

/// Where something stands in a file, for messages.
struct Place {
    std::filesystem::path file;
    int line = 0;
    std::string text() const { return file.string() + ":" + std::to_string(line); }
};

/// The application cannot be set up. what() is one line that begins with the place.
class SetupError : public std::runtime_error {
  public:
    explicit SetupError(const std::string& what) : std::runtime_error(what) {}
    SetupError(const Place& place, const std::string& what)
        : std::runtime_error(place.text() + ": " + what) {}
};

using Properties = std::vector<std::pair<std::string, std::string>>;

enum class Execution { periodic, periodic_shared, aperiodic, passive };

struct ComponentProfile {
    Place place, library_place;
    std::string name, library_name;
    Execution execution = Execution::passive;
    std::chrono::nanoseconds period{0}, phase{0};
    int priority = 0; ///< 1..99: real-time priority if permitted
    Properties properties;
};

struct Subcomponent {
    Place place;
    std::string name, reference;
    Properties properties; ///< override those of the component profile
};

struct PortReference {
    std::string component, port;
    std::string text() const { return component + "." + port; }
};

struct Connection {
    Place place;
    PortType type = OPROS_DATA;
    PortReference source, target;
};

/// The source's cycles need a cycle of the target before them.
struct Dependency {
    Place place;
    std::string source, target;
};

struct ApplicationProfile {
    Place place;
    std::string name;
    std::vector<Subcomponent> subcomponents;
    std::vector<Connection> connections;
    std::vector<Dependency> dependencies;
};

/// Both throw SetupError: no such file, not well-formed, not a profile of this kind, or something missing or
/// wrong.
ComponentProfile read_component_profile(const std::filesystem::path& file);
ApplicationProfile read_application_profile(const std::filesystem::path& file);

/// Where an application's component profile lies: in a folder named after the component or after the
/// application, beside the application profile, or in one of the plugin folders. Throws SetupError that lists
/// where it looked.
std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine

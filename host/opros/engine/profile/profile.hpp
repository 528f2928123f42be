// SPDX-License-Identifier: Apache-2.0
// Application and component profiles as the engine uses them.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <OPRoSTypes.h>

namespace tandem::engine {

/// Where something stands in a file, for messages.
struct SourceLocation {
    std::filesystem::path file;
    int line = 0;
    std::string text() const { return file.string() + ":" + std::to_string(line); }
};

/// The application cannot be set up. what() is one line that begins with the place.
class SetupError : public std::runtime_error {
  public:
    explicit SetupError(const std::string& what);
    SetupError(const SourceLocation& location, const std::string& what)
        : SetupError(location.text() + ": " + what) {}
};

using Properties = std::vector<std::pair<std::string, std::string>>;

/// aperiodic: when an input arrives; aperiodic_loop: again and again.
enum class ExecutionType { periodic, periodic_shared, aperiodic, aperiodic_loop, passive };
enum class SchedulingPolicy { other, fifo, round_robin };

constexpr unsigned int max_queue_size = 1000000;

/// The queue that a profile asks for.
struct QueueProfile {
    DataPortPolicy policy = OPROS_FIFO;
    unsigned int size = DEFAULT_QUEUE_LIMIT;
};

struct DataPortProfile {
    SourceLocation location;
    std::string name, data_type;
    bool is_input = false;
    std::optional<QueueProfile> queue; ///< of an input port, if the profile says something about it
};

struct EventPortProfile {
    SourceLocation location;
    std::string name, data_type;
    bool is_input = false;
};

struct ServicePortProfile {
    SourceLocation location;
    std::string name, type, reference; ///< reference: file of the service type's profile
    bool is_provided = false;
};

struct ComponentProfile {
    SourceLocation location, library_location;
    std::string name, library_name;
    ExecutionType execution_type = ExecutionType::passive;
    std::chrono::nanoseconds period{0}, phase{0};
    int priority = 0; ///< 0..99, for the real-time schedulings
    SchedulingPolicy scheduling_policy = SchedulingPolicy::other;
    Properties properties;
    // Ports as the profile lists them: those that the component has are of its code's making.
    std::vector<DataPortProfile> data_ports;
    std::vector<EventPortProfile> event_ports;
    std::vector<ServicePortProfile> service_ports;
    std::vector<std::string> port_errors;               ///< of ports that are left out here, one line each
    std::vector<std::string> data_types, service_types; ///< files of their profiles
};

struct Subcomponent {
    SourceLocation location;
    std::string name, reference;
    Properties properties;      ///< override those of the component profile
    std::filesystem::path file; ///< its profile, once found
};

struct PortReference {
    std::string component, port;
    std::string text() const { return component + "." + port; }
};

struct ConnectionProfile {
    SourceLocation location;
    PortType type = OPROS_DATA;
    PortReference source, target;
    std::string error; ///< why it cannot be made, as far as the profiles tell; empty if it can
};

/// The source's cycles need a cycle of the target before them.
struct Dependency {
    SourceLocation location;
    std::string source, target;
};

/// A port of a composite that is one of its components' in truth.
struct ExportedPort {
    SourceLocation location;
    std::string name;
    PortType type = OPROS_DATA;
    PortReference port;
};

/// An application, or a composite: components that are one component to those who use it.
struct ApplicationProfile {
    SourceLocation location;
    std::string name;
    std::vector<Subcomponent> subcomponents;
    std::vector<ConnectionProfile> connections;
    std::vector<Dependency> dependencies;
    std::vector<ExportedPort> exports; ///< composites only
};

class XmlFile;

enum class ProfileKind { component, composite, application, service_type, data_type };

/// All throw SetupError: no such file, not well-formed, not a profile of this kind, or something missing or
/// wrong.
ProfileKind read_profile_kind(const std::filesystem::path& file);
ComponentProfile read_component_profile(const std::filesystem::path& file);
ApplicationProfile read_application_profile(const std::filesystem::path& file);
ApplicationProfile read_composite_profile(const std::filesystem::path& file);
ComponentProfile read_component_profile(const XmlFile& xml);
ApplicationProfile read_application_profile(const XmlFile& xml);
ApplicationProfile read_composite_profile(const XmlFile& xml);

/// Where an application's component profile lies: in a folder named after the component or after the
/// application, beside the application profile, or in one of the plugin folders. Throws SetupError that lists
/// where it looked.
std::filesystem::path find_component_profile(const ApplicationProfile& application,
                                             const Subcomponent& component,
                                             const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine

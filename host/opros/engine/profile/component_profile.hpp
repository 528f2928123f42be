// SPDX-License-Identifier: Apache-2.0
// A component profile (<component_profile>): the component's library, execution type and properties, and the ports
// that its author lists.
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <OPRoSTypes.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tandem::engine {

/// Names and values, in the order of the profile.
using Properties = std::vector<std::pair<std::string, std::string>>;

/// Three names of one property. Components of OPRoS v1 test whether APIName is set and open the library in DllName.
constexpr const char* device_library_names[] = {"APIName", "ApiName", "DllName"};

/// When a component gets its cycles. periodic: in its own thread; periodic_shared: in one thread with other
/// components of the same period; aperiodic: when an input has arrived; aperiodic_loop: without a pause; passive:
/// never.
enum class ExecutionType { periodic, periodic_shared, aperiodic, aperiodic_loop, passive };
const char* name_of(ExecutionType type); ///< as profiles write it

/// The scheduling policies of sched_setscheduler(2).
enum class SchedulingPolicy { other, fifo, round_robin };

constexpr unsigned int max_queue_size = 1000000;

/// The queue that a profile asks for. `size` is the number of values, 1 to max_queue_size.
struct QueueProfile {
    DataPortPolicy policy = OPROS_FIFO;
    unsigned int size = DEFAULT_QUEUE_LIMIT;
};

struct DataPortProfile {
    SourceLocation location;
    std::string name, data_type;
    bool is_input = false;
    std::optional<QueueProfile> queue; ///< of an input port with a queue setting
};

struct EventPortProfile {
    SourceLocation location;
    std::string name, data_type;
    bool is_input = false;
};

struct ServicePortProfile {
    SourceLocation location;
    std::string name, type, reference; ///< reference: file of the service type profile
    bool is_provided = false;
};

/// A <property> as listed, only for messages about values that do not fit their types. The engine uses `properties`.
struct PropertyProfile {
    SourceLocation location;
    std::string name, type, value; ///< trimmed; the name may be empty
};

struct ComponentProfile {
    SourceLocation location, library_location; ///< of the root element and of <library_name>
    std::string name, library_name;
    ExecutionType execution_type = ExecutionType::passive;
    bool has_exclusive_thread = false;            ///< of the type periodic-exclusive
    std::chrono::nanoseconds period{0}, phase{0}; ///< of the periodic types
    int priority = 0;                             ///< 0..99, used with `fifo` and `round_robin` only
    SchedulingPolicy scheduling_policy = SchedulingPolicy::other;
    Properties properties;
    std::vector<PropertyProfile> property_profiles;
    // The ports that the profile lists. The engine connects the ports that the component's code adds, and uses only
    // the queue settings from here. `tandem opros check` compares both.
    std::vector<DataPortProfile> data_ports;
    std::vector<EventPortProfile> event_ports;
    std::vector<ServicePortProfile> service_ports;
    std::vector<std::string> port_errors;               ///< one line for each unusable port
    std::vector<std::string> structure_errors;          ///< from find_structure_errors()
    std::vector<std::string> data_types, service_types; ///< files of the type profiles
};

class XmlFile;

/// Reads a component profile. Throws SetupError if the file cannot be read, is not well-formed XML or not a component
/// profile, or if an element is missing or has a value out of range.
ComponentProfile read_component_profile(const std::filesystem::path& file);
ComponentProfile read_component_profile(const XmlFile& xml);

} // namespace tandem::engine

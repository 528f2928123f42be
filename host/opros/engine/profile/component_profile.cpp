// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/component_profile.hpp"

#include "host/opros/engine/profile/profile_structure.hpp"

#include <algorithm>
#include <cmath>

namespace tandem::engine {
namespace {

/// Three spellings of the same element: OPRoS v1.1, OPRoS v1, and hand-written profiles.
constexpr const char* queue_policy_elements[] = {"queueing_policy", "queuing_policy", "policy"};

pugi::xml_node find_queue_policy(const pugi::xml_node& port) {
    for (const char* name : queue_policy_elements)
        if (!XmlFile::child_text(port, name).empty()) return port.child(name);
    return {};
}

DataPortPolicy parse_queue_policy(const XmlFile& xml, const pugi::xml_node& node) {
    const std::string policy = XmlFile::keyword(node.child_value());
    if (policy == "fifo") return OPROS_FIFO;
    if (policy == "lifo") return OPROS_LIFO;
    if (policy == "ufifo") return OPROS_UFIFO;
    if (policy == "last") return OPROS_LAST;
    xml.fail(node, std::string("<") + node.name() + "> is '" + XmlFile::trim(node.child_value()) +
                       "', expected FIFO, LIFO, UFIFO or LAST");
}

/// `<queue_size>10</queue_size>` or, with `<policy>`, `<policy_param name="size">10</policy_param>`.
pugi::xml_node find_queue_size(const pugi::xml_node& port) {
    for (const pugi::xml_node& parameter : port.children("policy_param"))
        if (std::string(parameter.attribute("name").value()) == "size") return parameter;
    return port.child("queue_size");
}

std::optional<QueueProfile> read_queue_profile(const XmlFile& xml, const pugi::xml_node& port) {
    const pugi::xml_node policy = find_queue_policy(port), size = find_queue_size(port);
    const double limit = xml.number(size, DEFAULT_QUEUE_LIMIT);
    if (limit < 1 || limit > max_queue_size)
        xml.fail(size, "a queue has 1 to " + std::to_string(max_queue_size) + " places, got '" +
                           XmlFile::trim(size.child_value()) + "'");
    if (!policy && !size) return std::nullopt;
    return QueueProfile{policy ? parse_queue_policy(xml, policy) : OPROS_FIFO,
                        static_cast<unsigned int>(limit)};
}

std::string port_usage(const pugi::xml_node& port) {
    return XmlFile::keyword(port.child("usage").child_value());
}

/// Returns true if the port has a name and one of the two usages. Otherwise adds a line to `port_errors`.
bool check_port(const XmlFile& xml, const pugi::xml_node& port, const char* first_usage,
                const char* second_usage, ComponentProfile& profile) {
    const std::string name = XmlFile::child_text(port, "name"), usage = port_usage(port);
    const std::string prefix = xml.location(port).text() + ": <" + port.name() + "> ";
    if (name.empty()) {
        profile.port_errors.push_back(prefix + "lacks its <name>");
        return false;
    }
    if (usage == first_usage || usage == second_usage) return true;
    profile.port_errors.push_back(prefix + "'" + name + "' has the <usage> '" +
                                  XmlFile::child_text(port, "usage") + "', expected " + first_usage + " or " +
                                  second_usage);
    return false;
}

/// Reads the <ports> of a component profile into its lists of ports. Throws SetupError if a queue size is not a
/// number or out of range, or if a queue policy is unknown. Skips a port without a name or with an unknown <usage>
/// and adds a line to `port_errors`: real profiles contain such ports, and the original engine ignores them.
void read_port_profiles(const XmlFile& xml, const pugi::xml_node& ports, ComponentProfile& profile) {
    for (const pugi::xml_node& port : ports.children("data_port")) {
        if (!check_port(xml, port, "input", "output", profile)) continue;
        const bool is_input = port_usage(port) == "input";
        profile.data_ports.push_back({xml.location(port), XmlFile::child_text(port, "name"),
                                      XmlFile::child_text(port, "data_type"), is_input,
                                      is_input ? read_queue_profile(xml, port) : std::nullopt});
    }
    for (const pugi::xml_node& port : ports.children("event_port"))
        if (check_port(xml, port, "input", "output", profile))
            profile.event_ports.push_back({xml.location(port), XmlFile::child_text(port, "name"),
                                           XmlFile::child_text(port, "data_type"),
                                           port_usage(port) == "input"});
    for (const pugi::xml_node& port : ports.children("service_port"))
        if (check_port(xml, port, "provided", "required", profile))
            profile.service_ports.push_back(
                {xml.location(port), XmlFile::child_text(port, "name"), XmlFile::child_text(port, "type"),
                 XmlFile::child_text(port, "reference"), port_usage(port) == "provided"});
}

/// About 11 days. The limit keeps periods and phases far from the overflow of 64-bit nanoseconds.
constexpr double max_time_ms = 1e9;

std::chrono::nanoseconds milliseconds(double ms) { return std::chrono::nanoseconds(std::llround(ms * 1e6)); }

ExecutionType read_execution_type(const XmlFile& xml, const pugi::xml_node& semantics) {
    const std::string type = XmlFile::keyword(xml.required_child_text(semantics, "type"));
    if (type == "periodic" || type == "periodic-exclusive") return ExecutionType::periodic;
    if (type == "periodic-shared") return ExecutionType::periodic_shared;
    if (type == "aperiodic" || type == "non-periodic" || type == "nonperiodic")
        return ExecutionType::aperiodic;
    if (type == "aperiodic-loop") return ExecutionType::aperiodic_loop;
    if (type == "passive") return ExecutionType::passive;
    xml.fail(semantics.child("type"),
             "execution type '" + type +
                 "' is unknown, expected periodic, periodic-exclusive, periodic-shared, "
                 "aperiodic, aperiodic-loop or passive");
}

/// Returns a real-time policy only if the profile names one. Tools write a <priority> into every profile, so its
/// presence does not show what the author wants.
SchedulingPolicy read_scheduling_policy(const XmlFile& xml, const pugi::xml_node& semantics) {
    const pugi::xml_node node = semantics.child("policy");
    const std::string policy = XmlFile::keyword(node.child_value());
    if (policy == "sched_fifo") return SchedulingPolicy::fifo;
    if (policy == "sched_rr") return SchedulingPolicy::round_robin;
    if (policy.empty() || policy == "sched_other") return SchedulingPolicy::other;
    xml.fail(node, "<policy> is '" + XmlFile::trim(node.child_value()) +
                       "', expected SCHED_OTHER, SCHED_FIFO or SCHED_RR");
}

void read_period_and_phase(const XmlFile& xml, const pugi::xml_node& semantics, ComponentProfile& profile) {
    const double period = xml.number(semantics, "period", 0);
    if (period <= 0 || period > max_time_ms)
        xml.fail(semantics.child("period") ? semantics.child("period") : semantics,
                 "a periodic component needs a <period> above 0 and of at most 1e9 ms, got '" +
                     XmlFile::child_text(semantics, "period") + "'");
    profile.period = milliseconds(period);
    const double phase = xml.number(semantics, "phase", 0);
    if (std::abs(phase) > max_time_ms)
        xml.fail(semantics.child("phase"), "<phase> is '" + XmlFile::child_text(semantics, "phase") +
                                               "', expected a time in ms of at most 1e9");
    profile.phase = milliseconds(phase);
}

void read_execution_semantics(const XmlFile& xml, const pugi::xml_node& semantics,
                              ComponentProfile& profile) {
    profile.execution_type = read_execution_type(xml, semantics);
    profile.has_exclusive_thread =
        XmlFile::keyword(XmlFile::child_text(semantics, "type")) == "periodic-exclusive";
    profile.scheduling_policy = read_scheduling_policy(xml, semantics);
    profile.priority = static_cast<int>(std::clamp(xml.number(semantics, "priority", 0), 0., 99.));
    // Other profiles also contain a <period>, which is unused and may be 0.
    if (profile.execution_type == ExecutionType::periodic ||
        profile.execution_type == ExecutionType::periodic_shared)
        read_period_and_phase(xml, semantics, profile);
}

/// Reads the files of the type profiles that the component refers to. The names of the lists differ between tools.
void read_type_references(const pugi::xml_node& root, ComponentProfile& profile) {
    for (const auto& [list, files] : {std::pair{"data_type_list", &profile.data_types},
                                      std::pair{"defined_data_types", &profile.data_types},
                                      std::pair{"defined_service_types", &profile.service_types}})
        for (const pugi::xml_node& node : root.child(list).children())
            if (const std::string file = XmlFile::trim(node.child_value()); !file.empty())
                files->push_back(file);
}

} // namespace

const char* name_of(ExecutionType type) {
    static const char* const names[] = {"periodic", "periodic-shared", "aperiodic", "aperiodic-loop",
                                        "passive"};
    return names[static_cast<int>(type)];
}

ComponentProfile read_component_profile(const std::filesystem::path& file) {
    return read_component_profile(XmlFile(file));
}

ComponentProfile read_component_profile(const XmlFile& xml) {
    const pugi::xml_node root = xml.root({"component_profile"});
    ComponentProfile profile;
    profile.location = xml.location(root);
    profile.name = xml.required_child_text(root, "name");
    const pugi::xml_node environment = root.child("execution_environment");
    if (!environment) xml.fail(root, "<component_profile> lacks its <execution_environment>");
    profile.library_name = XmlFile::to_posix_path(xml.required_child_text(environment, "library_name"));
    profile.library_location = xml.location(environment.child("library_name"));
    const pugi::xml_node semantics = root.child("execution_semantics");
    if (!semantics) xml.fail(root, "<component_profile> lacks its <execution_semantics>");
    read_execution_semantics(xml, semantics, profile);
    for (const pugi::xml_node& property : root.child("properties").children("property")) {
        const std::string name = property.attribute("name").value();
        profile.property_profiles.push_back({xml.location(property), XmlFile::trim(name),
                                             XmlFile::trim(property.attribute("type").value()),
                                             XmlFile::trim(property.child_value())});
        if (!name.empty()) profile.properties.emplace_back(name, property.child_value());
    }
    read_port_profiles(xml, root.child("ports"), profile);
    read_type_references(root, profile);
    profile.structure_errors = find_structure_errors(xml);
    return profile;
}

} // namespace tandem::engine

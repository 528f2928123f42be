// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/component_profile.hpp"

#include "host/opros/engine/profile/port_profile.hpp"
#include "host/opros/engine/profile/xml_file.hpp"

#include <algorithm>
#include <cmath>

namespace tandem::engine {
namespace {

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
    return profile;
}

} // namespace tandem::engine

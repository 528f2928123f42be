// SPDX-License-Identifier: Apache-2.0
// Reads RTSystem profiles (RtsProfile 0.2) of RTSystemEditor and rtshell: the components of a system, their settings
// and connections.
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

/// Names and values, in the profile's order.
using RtsProperties = std::vector<std::pair<std::string, std::string>>;

struct RtsConfigurationSet {
    std::string id;
    RtsProperties values;
};

struct RtsComponent {
    engine::SourceLocation location;
    std::string name, type, category;       ///< instance name; type and category from the component's id
    std::string path;                       ///< HOST[:PORT]/CONTEXT/NAME.rtc; "" if missing
    std::string active_set, composite_type; ///< composite_type: "" if it is not a composite
    std::vector<RtsConfigurationSet> sets;  ///< without special sets, such as __widget__
    std::string kind;                       ///< of the first execution context: PERIODIC ...; "" if missing
    double rate = 0;                        ///< of the same context, in Hz; 0 if missing
};

struct RtsPort {
    std::string component, port; ///< instance name; name of the port without the component's
    std::string path;            ///< path of the component
    std::string text() const { return component + "." + port; }
};

struct RtsConnection {
    engine::SourceLocation location;
    bool is_service = false;
    RtsPort source, target;
    RtsProperties properties; ///< connector properties, each key once, with the prefix `dataport.` or `port.`
};

struct RtsProfile {
    std::filesystem::path file;
    std::vector<RtsComponent> components;
    std::vector<RtsConnection> connections;
    std::vector<engine::SourceLocation>
        sequences; ///< positions of <Activation> and similar elements, which define an order
};

/// Returns whether the root element is that of an RTSystem profile. Also returns true for unreadable files.
bool is_rts_profile(const std::filesystem::path& file);

/// Reads a profile. Throws engine::SetupError with file and line if the file is unreadable, is not well-formed XML or
/// not an RTSystem profile, or if an element lacks an attribute.
RtsProfile read_rts_profile(const std::filesystem::path& file);

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
// RTSystem profiles (RtsProfile 0.2), as RTSystemEditor and rtshell write them: which components a system has, their
// settings, and the connections between them.
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

/// Names and values, in the order of the profile.
using RtsProperties = std::vector<std::pair<std::string, std::string>>;

struct RtsConfigurationSet {
    std::string id;
    RtsProperties values;
};

struct RtsComponent {
    engine::SourceLocation location;
    std::string name, type, category; ///< instance name; the type and its category from the component's id
    std::string path;                 ///< HOST[:PORT]/CONTEXT/NAME.rtc, "" if the profile does not say
    std::string active_set, composite_type; ///< composite_type: "" if it is none
    std::vector<RtsConfigurationSet> sets;  ///< without those about other sets, as __widget__
    std::string kind;                       ///< of its first execution context: PERIODIC ..., or ""
    double rate = 0;                        ///< of that, in Hz; 0 if the profile does not say
};

struct RtsPort {
    std::string component, port; ///< instance name; name of the port without the component's
    std::string path;            ///< of the component
    std::string text() const { return component + "." + port; }
};

struct RtsConnection {
    engine::SourceLocation location;
    bool is_service = false;
    RtsPort source, target;
    RtsProperties properties; ///< of the connector, with `dataport.` or `port.` in front; each key once
};

struct RtsProfile {
    std::filesystem::path file;
    std::vector<RtsComponent> components;
    std::vector<RtsConnection> connections;
    std::vector<engine::SourceLocation> sequences; ///< of <Activation> and the like, which say in what order
};

/// Whether the file is an RTSystem profile, by its root element, or may be one, because it cannot be read.
bool is_rts_profile(const std::filesystem::path& file);

/// Throws engine::SetupError, a line with file and line: not readable, not well-formed XML, no RTSystem profile, or an
/// element lacks an attribute.
RtsProfile read_rts_profile(const std::filesystem::path& file);

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <string>

namespace RTC {

/// What Manager::createComponent() is asked for.
struct ComponentArguments {
    coil::Properties id;         ///< implementation_id, and optionally vendor, category, language, version
    coil::Properties properties; ///< those after the question mark
};

/// Parses `Name`, `Name?key=value&...` or `RTC:vendor:category:Name:language:version?...`. Throws ManagerError.
ComponentArguments parse_component_arguments(const std::string& args);

} // namespace RTC

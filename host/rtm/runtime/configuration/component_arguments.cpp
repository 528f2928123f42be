// SPDX-License-Identifier: Apache-2.0
// The argument of createComponent(), in the syntax of OpenRTM-aist's Manager::procComponentArgs().
#include "host/rtm/runtime/configuration/component_arguments.hpp"
#include <coil/stringutil.h>
#include <rtm/Manager.h>

namespace RTC {

ComponentArguments parse_component_arguments(const std::string& args) {
    ComponentArguments parsed;
    const std::size_t question_mark = args.find('?');
    const std::string type = coil::eraseBothEndsBlank(args.substr(0, question_mark));
    const auto parts = coil::split(type, ":");
    if (parts.size() == 6 && parts[0] == "RTC") {
        const char* const keys[] = {"", "vendor", "category", "implementation_id", "language", "version"};
        for (std::size_t i = 1; i < 6; ++i) parsed.id.setProperty(keys[i], parts[i]);
    } else if (parts.size() == 1 && !type.empty()) {
        parsed.id.setProperty("implementation_id", type);
    } else {
        throw ManagerError("`" + args + "` names no component type; expected Name or Name?key=value&...");
    }
    if (question_mark == std::string::npos) return parsed;
    for (const auto& parameter : coil::split(args.substr(question_mark + 1), "&", true)) {
        const std::size_t equals = parameter.find('=');
        if (equals == std::string::npos || equals == 0)
            throw ManagerError("`" + args + "`: expected key=value, found `" + parameter + "`");
        parsed.properties.setProperty(coil::eraseBothEndsBlank(parameter.substr(0, equals)),
                                      coil::eraseBothEndsBlank(parameter.substr(equals + 1)));
    }
    return parsed;
}

} // namespace RTC

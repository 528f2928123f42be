// SPDX-License-Identifier: Apache-2.0
// Name formats as OpenRTM-aist's Manager::formatString() expands them.
#include "host/rtm/runtime/configuration/format_name.hpp"
#include <cstdlib>

namespace RTC {
namespace {

// Appends the value of the variable that begins at format[at] (a `$`), nothing when it is not set. Returns
// the index of the reference's last character. A name without braces ends at one of `./%-`, which separate
// the parts of a name format.
std::size_t expand_variable(const std::string& format, std::size_t at, std::string& out) {
    const bool braces = format.compare(at, 2, "${") == 0;
    const std::size_t begin = at + (braces ? 2 : 1);
    const std::size_t end = format.find_first_of(braces ? "}" : "./%-", begin);
    const std::string name = format.substr(begin, end == std::string::npos ? end : end - begin);
    if (const char* value = std::getenv(name.c_str())) out += value;
    if (end == std::string::npos) return format.size() - 1;
    return braces ? end : end - 1;
}

// `Name0` of implementation id `Name` -> `0`; a name that does not begin with the id is kept whole.
std::string instance_number(const coil::Properties& component) {
    const std::string name = component.getProperty("instance_name");
    const std::string id = component.getProperty("implementation_id");
    return name.compare(0, id.size(), id) == 0 ? name.substr(id.size()) : name;
}

std::string expand_code(char code, const coil::Properties& component, const coil::Properties& config) {
    switch (code) {
    case 'n':
        return component.getProperty("instance_name");
    case 't':
    case 'm':
        return component.getProperty("type_name");
    case 'v':
        return component.getProperty("version");
    case 'V':
        return component.getProperty("vendor");
    case 'c':
        return component.getProperty("category");
    case 'i':
        return component.getProperty("implementation_id");
    case 'N':
        return instance_number(component);
    case 'h':
        return config.getProperty("os.hostname");
    case 'M':
        return config.getProperty("manager.name");
    case 'p':
        return config.getProperty("manager.pid");
    default:
        return std::string(1, code);
    }
}

} // namespace

std::string format_name(const std::string& format, const coil::Properties& component,
                        const coil::Properties& config) {
    std::string out;
    for (std::size_t i = 0; i < format.size(); ++i) {
        if (format[i] == '$')
            i = expand_variable(format, i, out);
        else if (format[i] == '%' && i + 1 < format.size())
            out += expand_code(format[++i], component, config);
        else
            out += format[i];
    }
    return out;
}

} // namespace RTC

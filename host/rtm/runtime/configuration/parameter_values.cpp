// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/parameter_values.hpp"
#include <locale>
#include <sstream>
#include <type_traits>

namespace RTC {
namespace {

template <class T>
bool converts(const std::string& text) {
    T value{};
    return coil::stringTo(value, text.c_str());
}

/// Returns whether the text is a value of the type and nothing more: 90deg converts to 90, but the rest would be
/// ignored.
template <class T>
bool is_plain_value(const std::string& text) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
        std::istringstream in(text);
        in.imbue(std::locale::classic());
        T value{};
        return static_cast<bool>(in >> value) && (in.eof() || (in >> std::ws).eof());
    } else {
        return converts<T>(text);
    }
}

/// Returns the beginning of the text that converts to a number.
template <class T>
std::string beginning(const std::string& text) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
        std::istringstream in(text);
        in.imbue(std::locale::classic());
        T value{};
        in >> value;
        return in.eof() || !in
                   ? text
                   : coil::eraseBothEndsBlank(text.substr(0, static_cast<std::size_t>(in.tellg())));
    } else {
        return text;
    }
}

/// One type of variable, and its name for users.
struct VariableType {
    bool (*is_type_of)(const ConfigBase&);
    bool (*converts)(const std::string&);
    bool (*is_plain_value)(const std::string&);
    std::string (*beginning)(const std::string&);
    bool is_number;
    const char* name;
};

template <class T>
VariableType variable_type(const char* name) {
    return {[](const ConfigBase& parameter) { return dynamic_cast<const Config<T>*>(&parameter) != nullptr; },
            converts<T>,
            is_plain_value<T>,
            beginning<T>,
            std::is_arithmetic_v<T>,
            name};
}

const VariableType variable_types[] = {
    variable_type<bool>("true or false (bool)"),
    variable_type<short>("a whole number (short)"),
    variable_type<unsigned short>("a whole number (unsigned short)"),
    variable_type<int>("a whole number (int)"),
    variable_type<unsigned int>("a whole number (unsigned int)"),
    variable_type<long>("a whole number (long)"),
    variable_type<unsigned long>("a whole number (unsigned long)"),
    variable_type<long long>("a whole number (long long)"),
    variable_type<unsigned long long>("a whole number (unsigned long long)"),
    variable_type<float>("a number (float)"),
    variable_type<double>("a number (double)"),
    variable_type<std::vector<int>>("whole numbers separated by commas (int)"),
    variable_type<std::vector<long>>("whole numbers separated by commas (long)"),
    variable_type<std::vector<float>>("numbers separated by commas (float)"),
    variable_type<std::vector<double>>("numbers separated by commas (double)"),
};

} // namespace

// For numbers it is known whether the component converts them with its own function. For other types, a default that is more
// than a plain value of the type shows that.
std::string expected_instead(const ConfigBase& parameter, const std::string& value) {
    for (const VariableType& type : variable_types) {
        if (!type.is_type_of(parameter)) continue;
        const bool is_own =
            type.is_number ? !parameter.is_plain_number : !type.is_plain_value(parameter.default_value);
        return type.converts(value) || is_own ? "" : type.name;
    }
    return "";
}

std::string expected_alone(const ConfigBase& parameter, const std::string& value) {
    if (!parameter.is_plain_number) return "";
    for (const VariableType& type : variable_types)
        if (type.is_type_of(parameter) && type.converts(value) && !type.is_plain_value(value))
            return type.name;
    return "";
}

std::string used_beginning(const ConfigBase& parameter, const std::string& value) {
    for (const VariableType& type : variable_types)
        if (type.is_type_of(parameter)) return type.beginning(value);
    return value;
}

std::string& last_refused_value() {
    thread_local std::string refused;
    return refused;
}

} // namespace RTC

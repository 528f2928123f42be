// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/load/property_types.hpp"

#include "host/opros/engine/profile/xml_file.hpp"
#include "host/text/nearest_name.hpp"
#include "host/text/parse_number.hpp"

#include <algorithm>
#include <cctype>

namespace tandem::engine {
namespace {

enum class Kind { whole_number, number, truth, text };

/// The types that profiles use, spelled as in C++.
struct PropertyType {
    const char* name;
    Kind kind;
};
constexpr PropertyType property_types[] = {
    {"int", Kind::whole_number},
    {"unsigned int", Kind::whole_number},
    {"short", Kind::whole_number},
    {"unsigned short", Kind::whole_number},
    {"long", Kind::whole_number},
    {"unsigned long", Kind::whole_number},
    {"long long", Kind::whole_number},
    {"unsigned long long", Kind::whole_number},
    {"double", Kind::number},
    {"float", Kind::number},
    {"bool", Kind::truth},
    {"string", Kind::text},
    {"std::string", Kind::text},
    {"char", Kind::text},
    {"unsigned char", Kind::whole_number},
};

/// Returns what a value of this kind must be, or an empty string if the text is such a value.
std::string expected_instead(Kind kind, const std::string& value) {
    switch (kind) {
    case Kind::whole_number: // accepts 50.0: components use atoi(), which reads it as 50
        return text::parse_number(value) ? "" : "a whole number";
    case Kind::number:
        return text::parse_number(value) ? "" : "a number";
    case Kind::truth: {
        const std::string word = XmlFile::keyword(value);
        return word == "true" || word == "false" || word == "1" || word == "0" ? "" : "true or false";
    }
    case Kind::text:
        break;
    }
    return "";
}

/// Returns the error in the type or the value of a property, or an empty string. Does not check an unknown type with
/// characters other than letters and blanks, such as vector<int>, or an empty value.
std::string type_error(const std::string& name, const std::string& type, const std::string& value) {
    const auto is_plain = [](unsigned char c) { return std::isalpha(c) || c == ' '; };
    const auto* const end = std::end(property_types);
    const auto* const known = std::find_if(std::begin(property_types), end,
                                           [&](const PropertyType& each) { return type == each.name; });
    if (known == end)
        return type.empty() || !std::all_of(type.begin(), type.end(), is_plain)
                   ? ""
                   : "property " + name + " has the unknown type '" + type +
                         "', expected int, double, string, bool or another type of C++";
    const std::string expected = value.empty() ? "" : expected_instead(known->kind, value);
    return expected.empty()
               ? ""
               : "property " + name + " is '" + value + "', expected " + expected + " (type " + type + ")";
}

/// Returns the device library property that `name` probably means: one that starts with `name` or differs by one
/// letter. Returns an empty string if there is none.
std::string device_library_name_meant(const std::string& name) {
    if (name.size() >= 3)
        for (std::string known : device_library_names)
            if (known.compare(0, name.size(), name) == 0) return known;
    const std::string word = XmlFile::keyword(name);
    for (const char* known : device_library_names) {
        const std::string lower = XmlFile::keyword(known);
        if (word.size() >= 3 &&
            (lower.compare(0, word.size(), word) == 0 || text::edit_distance(word, lower) == 1))
            return known;
    }
    return "";
}

/// Without any of these names, a component does not start and reports only an error number.
void add_misspelt_device_library(const ComponentProfile& profile, std::vector<std::string>& errors) {
    const auto has = [&](const char* name) {
        return std::any_of(profile.properties.begin(), profile.properties.end(),
                           [&](const auto& property) { return property.first == name; });
    };
    if (std::any_of(std::begin(device_library_names), std::end(device_library_names), has)) return;
    for (const PropertyProfile& property : profile.property_profiles)
        if (const std::string meant = device_library_name_meant(property.name); !meant.empty())
            errors.push_back(
                property.location.text() + ": property " + property.name +
                ": components ask for their device library as APIName, ApiName or DllName; did you mean " +
                meant + "?");
}

} // namespace

std::vector<std::string> find_property_type_errors(const ComponentProfile& profile) {
    std::vector<std::string> errors;
    for (const PropertyProfile& property : profile.property_profiles) {
        const std::string error = property.name.empty()
                                      ? "<property> lacks its attribute name"
                                      : type_error(property.name, property.type, property.value);
        if (!error.empty()) errors.push_back(property.location.text() + ": " + error);
    }
    add_misspelt_device_library(profile, errors);
    return errors;
}

} // namespace tandem::engine

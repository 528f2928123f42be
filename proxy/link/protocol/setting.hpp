// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <string>

namespace tandem::link {

/// Parses the value of a setting: a number above 0 and below 10^6. Returns `default_value` if the text is empty.
/// Throws std::runtime_error, one line, in which `kind` is the model's word for a setting: property or parameter.
inline double parse_positive_number(const char* kind, const std::string& name, const std::string& text,
                                    double default_value) {
    if (text.empty()) return default_value;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value < 1e6))
        throw std::runtime_error(
            fmt::format("{} '{}' is '{}': expected a number above 0 and below 1000000", kind, name, text));
    return value;
}

/// Parses a setting that is on or off: 1, true, YES, ... or 0, false, NO, ... An empty text means off. Throws
/// std::runtime_error, one line, like parse_positive_number().
inline bool parse_flag(const char* kind, const std::string& name, const std::string& text) {
    std::string lower;
    for (const char c : text) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (lower.empty() || lower == "0" || lower == "false" || lower == "no") return false;
    if (lower == "1" || lower == "true" || lower == "yes") return true;
    throw std::runtime_error(fmt::format("{} '{}' is '{}': expected 0 or 1", kind, name, text));
}

} // namespace tandem::link

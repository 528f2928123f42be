// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <string>

namespace tandem::link {

/// The number above 0 (and below 10^6) that a setting's text says, `otherwise` if it is empty. Throws
/// std::runtime_error, one line, that calls the setting a `kind`: property, parameter.
inline double positive_number(const char* kind, const std::string& name, const std::string& text,
                              double otherwise) {
    if (text.empty()) return otherwise;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value < 1e6))
        throw std::runtime_error(
            fmt::format("{} '{}' is '{}', a number above 0 was expected", kind, name, text));
    return value;
}

} // namespace tandem::link

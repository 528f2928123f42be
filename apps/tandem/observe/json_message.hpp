// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/wire/type.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace tandem::command {

/// Parses JSON from outside. Throws std::runtime_error if it is invalid or nested more than 64 levels deep,
/// because copying a value recurses.
nlohmann::json parse_json(std::string_view text);

/// Encodes JSON as a message in CDR; the reverse of message_to_json(). Octets may be a list of numbers.
/// Absent members are zero or empty; an absent leading RTM time is the current time. Throws
/// std::runtime_error with one line that names the member if a value does not fit, or if the type has an
/// any, fixed, wide character or object.
std::vector<std::byte> json_to_message(const wire::Type& message, const nlohmann::json& json);

/// Returns whether each value of the type takes bytes, so that decoding ends with the message. A hostile
/// type could be an array of a billion empty structures.
bool takes_bytes(const wire::Type& type);

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/wire/type.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace tandem::command {

/// JSON that somebody else has written, which may be copied. Throws std::runtime_error for what is none, or is nested more than 64 levels deep:
/// copying goes as deep as the value.
nlohmann::json parse_json(std::string_view text);

/// The reverse of message_to_json(): encodes a message of that type in CDR, from what that writes. Octets may be a list of
/// numbers, too. Members that are absent are zero or empty, but a leading RTM time is the current one. Throws
/// std::runtime_error, one line that names the member, for what does not fit: an unknown member, a value of another kind,
/// out of range or beyond a bound; also for a type with an any, a fixed, a wide character or an object.
std::vector<std::byte> json_to_message(const wire::Type& message, const nlohmann::json& json);

/// Whether each value of the type takes bytes of a message, so that decoding ends with them: the type of another process could
/// name an array of a billion empty structures, or hold it in an any.
bool takes_bytes(const wire::Type& type);

} // namespace tandem::command

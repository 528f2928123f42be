// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/followed_port.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <nlohmann/json.hpp>

namespace tandem::command {

/// Decodes a message of that type. Structures are objects, of members without names lists; sequences and arrays are lists,
/// those of octets a string of hexadecimal digits; enumerations are their numbers, which is all that crosses; a union is
/// an object of "case" and "value"; an any one of "type", its signature, and "value". Numbers that JSON has not (infinity,
/// NaN) are strings. Throws std::runtime_error if the bytes, which another process wrote, are no such message.
nlohmann::ordered_json message_to_json(const wire::Type& message, std::span<const std::byte> bytes);
/// The same for a message of a port as it was copied off the link: `stamp` is the record's.
nlohmann::ordered_json message_to_json(const FollowedPort& port, std::span<const std::byte> bytes,
                                       std::uint64_t stamp);

} // namespace tandem::command

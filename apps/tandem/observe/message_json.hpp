// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/followed_port.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <nlohmann/json.hpp>

namespace tandem::command {

/// Decodes a message. Structures become objects, or lists if members have no names; octet sequences become
/// hexadecimal strings; enumerations become numbers; a union becomes an object of "case" and "value", an
/// any one of "type" and "value". Infinity and NaN become strings. Throws std::runtime_error if the bytes
/// are not a message of that type.
nlohmann::ordered_json message_to_json(const wire::Type& message, std::span<const std::byte> bytes);
/// Decodes a message of a port as copied from the link, with the record's `stamp`.
nlohmann::ordered_json message_to_json(const FollowedPort& port, std::span<const std::byte> bytes,
                                       std::uint64_t stamp);

} // namespace tandem::command

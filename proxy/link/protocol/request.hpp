// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tandem::link {

/// One call across the link: an operation of a service port, or with an empty port name a command of
/// control.hpp. In a slot of the call queue: port, operation and signature as CDR strings, padding to a
/// multiple of 8, the arguments in CDR.
struct Request {
    std::string_view port;
    std::string_view operation;
    std::string_view signature; ///< `arguments:result` as the caller has them
    std::span<const std::byte> arguments;
};

/// Replaces the content of `out`, whose capacity is kept: repeated calls do not allocate.
void encode(const Request&, std::vector<std::byte>& out);
/// Returns views into `bytes`, which another process wrote; nothing when they are no request.
std::optional<Request> decode_request(std::span<const std::byte> bytes);

} // namespace tandem::link

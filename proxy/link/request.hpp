// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tandem::link {

/// One call across the link: a service port's operation, or with an empty port a control command of the link
/// itself. In the slot: port, operation, signature (CDR strings), padding to 8, the arguments in CDR.
struct Request {
    std::string_view port;
    std::string_view operation;
    std::string_view signature; ///< `arguments:result` as the caller has them
    std::span<const std::byte> arguments;
};

/// Appends the request to `out` (cleared first), whose capacity is kept.
void encode(const Request&, std::vector<std::byte>& out);
/// A view into `bytes`; nothing when they are no request.
std::optional<Request> decode_request(std::span<const std::byte> bytes);

} // namespace tandem::link

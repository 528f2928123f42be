// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"

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

void encode(const Request&, wire::CdrWriter& out);

/// What the requests of one operation begin with, encoded once: this and the arguments are a request.
class RequestHead {
  public:
    RequestHead() = default;
    RequestHead(std::string_view port, std::string_view operation, std::string_view signature);
    void put(wire::CdrWriter& out) const { out.put_block(bytes_.data(), bytes_.size(), 1); }

  private:
    std::vector<std::byte> bytes_;
};

/// Returns views into `bytes`, which another process wrote; nothing when they are no request.
std::optional<Request> decode_request(std::span<const std::byte> bytes);

} // namespace tandem::link

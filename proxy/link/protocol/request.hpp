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
/// control.hpp. In a slot of the call queue: two ids, or 0, and the length of all that comes before the arguments; port,
/// operation and signature as CDR strings, padding to a multiple of 8; the arguments in CDR.
struct Request {
    std::string_view port;
    std::string_view operation;
    std::string_view signature; ///< `arguments:result` as the caller has them
    std::span<const std::byte> arguments;
};

/// What stands for the names of an operation, so that nobody has to look for texts: a hash of the port's name, and one of
/// the operation's and its signature. Who calls by an id gets the operation of that id, whatever the texts say.
struct RequestId {
    std::uint64_t port = 0, operation = 0;
};
std::uint64_t port_id(std::string_view port);
std::uint64_t operation_id(std::string_view operation, std::string_view signature);

/// Without ids.
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

/// The ids of a request and its arguments, without a look at the texts.
struct KnownRequest {
    RequestId id;
    std::span<const std::byte> arguments;
};
/// Nothing when `bytes`, which another process wrote, are no request or one without ids.
std::optional<KnownRequest> decode_known_request(std::span<const std::byte> bytes);

/// Returns views into `bytes`, which another process wrote; nothing when they are no request.
std::optional<Request> decode_request(std::span<const std::byte> bytes);

} // namespace tandem::link

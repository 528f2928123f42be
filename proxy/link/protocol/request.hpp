// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
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

/// The arguments of a request are a CDR message of their own, aligned from its start.
constexpr std::size_t argument_alignment = 8;

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
[[gnu::always_inline]] inline std::optional<KnownRequest>
decode_known_request(std::span<const std::byte> bytes) {
    struct {
        RequestId id;
        std::uint32_t head_bytes;
    } begin;
    constexpr std::size_t shortest_head = sizeof begin.id + sizeof begin.head_bytes;
    if (bytes.size() < sizeof begin) return std::nullopt;
    std::memcpy(&begin, bytes.data(), sizeof begin);
    if (begin.id.port == 0 || begin.head_bytes > bytes.size() || begin.head_bytes < shortest_head ||
        begin.head_bytes % argument_alignment != 0)
        return std::nullopt;
    return KnownRequest{begin.id, bytes.subspan(begin.head_bytes)};
}

/// Returns views into `bytes`, which another process wrote; nothing when they are no request.
std::optional<Request> decode_request(std::span<const std::byte> bytes);

} // namespace tandem::link

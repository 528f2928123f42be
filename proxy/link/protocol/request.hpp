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

/// One call across the link: an operation of a service port or, with an empty port name, a command of control.hpp.
/// Layout in a slot of the call queue: two ids, or 0, and the length of everything before the arguments; port,
/// operation and signature as CDR strings; padding to a multiple of 8; the arguments in CDR.
struct Request {
    std::string_view port;
    std::string_view operation;
    std::string_view signature; ///< `arguments:result`, as the caller knows it
    std::span<const std::byte> arguments;
};

/// The arguments of a request are a separate CDR message, aligned from its start.
constexpr std::size_t argument_alignment = 8;

/// Replaces the names of an operation, so that no texts are compared: a hash of the port's name, and a hash of the
/// operation's name and signature. A call with an id gets the operation with this id, independent of the texts.
struct RequestId {
    std::uint64_t port = 0, operation = 0;
};
std::uint64_t port_id(std::string_view port);
std::uint64_t operation_id(std::string_view operation, std::string_view signature);

/// Encodes a request without ids.
void encode(const Request&, wire::CdrWriter& out);

/// The beginning of all requests of one operation, encoded once. A request is this head and the arguments.
class RequestHead {
  public:
    RequestHead() = default;
    RequestHead(std::string_view port, std::string_view operation, std::string_view signature);
    void put(wire::CdrWriter& out) const { out.put_block(bytes_.data(), bytes_.size(), 1); }

  private:
    std::vector<std::byte> bytes_;
};

/// The ids of a request and its arguments. Excludes the texts.
struct KnownRequest {
    RequestId id;
    std::span<const std::byte> arguments;
};
/// Returns nothing if `bytes`, from another process, are not a request or a request without ids.
inline std::optional<KnownRequest> decode_known_request(std::span<const std::byte> bytes) {
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

/// Returns views into `bytes`, from another process, or nothing if they are not a request.
std::optional<Request> decode_request(std::span<const std::byte> bytes);

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/request.hpp"

namespace tandem::link {
namespace {

constexpr std::size_t ids_bytes = 2 * sizeof(std::uint64_t);

/// Returns the end of a CDR string that begins at `position`.
std::size_t end_of_string(std::size_t position, std::string_view text) {
    return (position + 3) / 4 * 4 + sizeof(std::uint32_t) + text.size() + 1;
}

void put_head(wire::CdrWriter& out, const RequestId& id, const Request& request) {
    out.put(id.port);
    out.put(id.operation);
    std::size_t end = ids_bytes + sizeof(std::uint32_t);
    for (const auto text : {request.port, request.operation, request.signature})
        end = end_of_string(end, text);
    out.put(
        static_cast<std::uint32_t>((end + argument_alignment - 1) / argument_alignment * argument_alignment));
    for (const auto text : {request.port, request.operation, request.signature}) out.put_string(text);
    out.align(argument_alignment);
}

/// FNV-1a, http://www.isthe.com/chongo/tech/comp/fnv/.
std::uint64_t hash(std::string_view text, std::uint64_t value = 0xcbf29ce484222325U) {
    for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return value;
}
std::uint64_t nonzero(std::uint64_t value) { return value == 0 ? 1 : value; }

} // namespace

void encode(const Request& request, wire::CdrWriter& out) {
    put_head(out, {}, request);
    out.put_block(request.arguments.data(), request.arguments.size(), argument_alignment);
}

RequestHead::RequestHead(std::string_view port, std::string_view operation, std::string_view signature) {
    wire::CdrWriter out(bytes_);
    put_head(out, {port_id(port), operation_id(operation, signature)}, {port, operation, signature, {}});
}

std::uint64_t port_id(std::string_view port) { return nonzero(hash(port)); }
std::uint64_t operation_id(std::string_view operation, std::string_view signature) {
    return nonzero(hash(signature, hash(std::string_view("\0", 1), hash(operation))));
}

std::optional<Request> decode_request(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Request request;
    in.get_block(ids_bytes + sizeof(std::uint32_t), 1);
    request.port = in.get_string();
    request.operation = in.get_string();
    request.signature = in.get_string();
    if (!in.align(argument_alignment)) return std::nullopt;
    request.arguments = bytes.subspan(in.position());
    return request;
}

} // namespace tandem::link

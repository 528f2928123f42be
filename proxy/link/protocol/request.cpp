// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/request.hpp"

namespace tandem::link {
namespace {

// The arguments are a CDR message of their own, aligned from its start.
constexpr std::size_t argument_alignment = 8;

void put_head(wire::CdrWriter& out, const Request& request) {
    for (const auto text : {request.port, request.operation, request.signature}) out.put_string(text);
    out.align(argument_alignment);
}

} // namespace

void encode(const Request& request, wire::CdrWriter& out) {
    put_head(out, request);
    out.put_block(request.arguments.data(), request.arguments.size(), argument_alignment);
}

RequestHead::RequestHead(std::string_view port, std::string_view operation, std::string_view signature) {
    wire::CdrWriter out(bytes_);
    put_head(out, {port, operation, signature, {}});
}

[[gnu::hot]] std::optional<Request> decode_request(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Request request;
    request.port = in.get_string();
    request.operation = in.get_string();
    request.signature = in.get_string();
    if (!in.align(argument_alignment)) return std::nullopt;
    request.arguments = bytes.subspan(in.position());
    return request;
}

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/request.hpp"

#include "proxy/wire/cdr.hpp"

namespace tandem::link {
namespace {

void put(wire::CdrWriter& out, const Request& request) {
    for (const auto text : {request.port, request.operation, request.signature}) out.put_string(text);
    out.put_block(request.arguments.data(), request.arguments.size(), 8);
}

} // namespace

void encode(const Request& request, std::vector<std::byte>& out) {
    wire::CdrWriter measure({}); // writes nothing, counts
    put(measure, request);
    out.resize(measure.size());
    wire::CdrWriter writer(out);
    put(writer, request);
}

std::optional<Request> decode_request(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Request request;
    request.port = in.get_string();
    request.operation = in.get_string();
    request.signature = in.get_string();
    // The arguments are a CDR message of their own, aligned from its start.
    if (!in.align(8)) return std::nullopt;
    request.arguments = bytes.subspan(in.position());
    return request;
}

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/method_check.hpp"

#include "proxy/adaptor/archive/signature_archive.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::adaptor {

std::optional<std::string> method_signature(Method& method) {
    SignatureArchive arguments, result;
    try {
        if (!method.describe(arguments, result)) return std::nullopt;
    } catch (const std::exception&) {
        return std::nullopt;
    }
    // The archive writes down what it is asked for; parsing brings that into the canonical form.
    const auto operation = wire::parse_operation_signature(arguments.signature() + ":" + result.signature());
    return operation.arguments + ":" + operation.result;
}

std::string check_method(const link::Port& peer, const std::string& name, const std::string& signature) {
    // An interface whose IDL the RTM host does not know has no operations in the table: the call itself will
    // show whether they fit.
    if (peer.operations.empty()) return "";
    const auto known = std::find_if(peer.operations.begin(), peer.operations.end(),
                                    [&](const auto& operation) { return operation.name == name; });
    if (known == peer.operations.end())
        return fmt::format("service port '{}': the peer's interface {} has no operation '{}'", peer.name,
                           peer.type, name);
    const auto peer_signature = wire::parse_operation_signature(known->signature);
    if (peer_signature == wire::parse_operation_signature(signature)) return "";
    return fmt::format(
        "service port '{}': method '{}' has signature '{}', the peer's operation of interface {} has "
        "'{}'",
        peer.name, name, signature, peer.type, known->signature);
}

// A reply carries a text where the failing side knows more than the status says.
std::string describe_failure(const link::Reply& reply, std::chrono::milliseconds call_timeout) {
    switch (reply.status) {
    case link::CallStatus::timeout:
        return fmt::format("no reply within {} ms", call_timeout.count());
    case link::CallStatus::peer_died:
        return "the peer is not there";
    case link::CallStatus::overload:
        return "too many calls are under way";
    case link::CallStatus::shut_down:
        return "the link is closing";
    case link::CallStatus::no_such_operation:
        return reply.bytes.empty() ? "the peer has no such operation" : reply.text();
    case link::CallStatus::bad_arguments:
        return reply.bytes.empty() ? "the peer cannot read the arguments" : reply.text();
    default:
        return reply.bytes.empty() ? "the peer's component failed" : reply.text();
    }
}

} // namespace tandem::adaptor

// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/method_check.hpp"

#include "proxy/adaptor/signature_archive.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::adaptor {

std::optional<std::string> signature_of(Method& method) {
    SignatureArchive arguments, result;
    try {
        if (!method.describe(arguments, result)) return std::nullopt;
    } catch (const std::exception&) {
        return std::nullopt;
    }
    const auto operation = wire::parse_operation(arguments.signature() + ":" + result.signature());
    return operation.arguments + ":" + operation.result;
}

std::string check_method(const link::Port& partner, const std::string& name, const std::string& signature) {
    if (partner.operations.empty()) return "";
    const auto known = std::find_if(partner.operations.begin(), partner.operations.end(),
                                    [&](const auto& operation) { return operation.name == name; });
    if (known == partner.operations.end())
        return fmt::format("service port '{}': the partner's interface {} has no operation '{}'",
                           partner.name, partner.type, name);
    const auto theirs = wire::parse_operation(known->signature);
    if (theirs == wire::parse_operation(signature)) return "";
    return fmt::format(
        "service port '{}': method '{}' has signature '{}', the partner's operation of interface {} has "
        "'{}'",
        partner.name, name, signature, partner.type, known->signature);
}

std::string describe(const link::Answer& answer, std::chrono::milliseconds call_timeout) {
    switch (answer.status) {
    case link::CallStatus::timeout:
        return fmt::format("no answer within {} ms", call_timeout.count());
    case link::CallStatus::peer_died:
        return "the partner is not there";
    case link::CallStatus::overload:
        return "too many calls are under way";
    case link::CallStatus::shut_down:
        return "the link is closing";
    case link::CallStatus::no_such_operation:
        return answer.bytes.empty() ? "the partner has no such operation" : answer.text();
    case link::CallStatus::bad_arguments:
        return answer.bytes.empty() ? "the partner cannot read the arguments" : answer.text();
    default:
        return answer.bytes.empty() ? "the partner's component failed" : answer.text();
    }
}

} // namespace tandem::adaptor

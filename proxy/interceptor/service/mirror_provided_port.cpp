// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/mirror_provided_port.hpp"

#include "proxy/interceptor/corba/generic_call.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::interceptor {
namespace {

using link::CallStatus;
using link::Reply;

/// What the peer sees of the result of a CORBA call.
CallStatus status_of(GenericCallResult::Status status) {
    switch (status) {
    case GenericCallResult::Status::ok:
        return CallStatus::ok;
    case GenericCallResult::Status::no_such_operation:
        return CallStatus::no_such_operation;
    case GenericCallResult::Status::bad_arguments:
        return CallStatus::bad_arguments;
    case GenericCallResult::Status::timeout:
        return CallStatus::timeout;
    default:
        return CallStatus::exception;
    }
}

} // namespace

MirrorProvidedPort::MirrorProvidedPort(link::Port port, std::chrono::milliseconds call_timeout)
    : port_(std::move(port)), call_timeout_(call_timeout) {}

const MirrorProvidedPort::Types& MirrorProvidedPort::parsed_types(std::string_view signature) {
    const std::lock_guard lock(mutex_);
    const auto known = types_.find(signature);
    if (known != types_.end()) return known->second;
    const auto operation = wire::parse_operation_signature(signature);
    Types types{wire::parse_signature(operation.arguments), wire::parse_signature(operation.result)};
    return types_.emplace(signature, std::move(types)).first->second;
}

/// Returns an error if the interface has no such operation, or with another signature. AdaptorComp has checked
/// the same at connection, but it is another process and not trusted.
std::string MirrorProvidedPort::check_operation(const link::Request& request) const {
    // Without the IDL there is nothing to compare with: the CORBA object refuses what it does not know.
    if (port_.operations.empty()) return "";
    const auto known =
        std::find_if(port_.operations.begin(), port_.operations.end(),
                     [&](const auto& operation) { return operation.name == request.operation; });
    if (known == port_.operations.end()) return fmt::format("interface {} has no such operation", port_.type);
    if (wire::parse_operation_signature(known->signature) ==
        wire::parse_operation_signature(request.signature))
        return "";
    return fmt::format("the operation has signature '{}', not '{}'", known->signature, request.signature);
}

Reply MirrorProvidedPort::serve(const link::Request& request) {
    try {
        const std::string error = check_operation(request);
        if (!error.empty()) return Reply::failure(CallStatus::bad_arguments, error);
        // Parsing takes longer than converting a small call, so each signature is parsed once.
        const Types& expected = parsed_types(request.signature);
        auto result = generic_call(consumer_.getObject(), std::string(request.operation), expected.arguments,
                                   expected.result, request.arguments, call_timeout_);
        if (result.status == GenericCallResult::Status::ok)
            return {CallStatus::ok, std::move(result.results)};
        return Reply::failure(status_of(result.status), result.text);
    } catch (const wire::SignatureError& error) { // the request's: it came from another process
        return Reply::failure(CallStatus::bad_arguments, error.what());
    }
}

} // namespace tandem::interceptor

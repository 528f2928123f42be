// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/mirror_provided_port.hpp"

#include "proxy/interceptor/generic_call.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::interceptor {
namespace {

using link::Answer;
using link::CallStatus;

CallStatus status_of(GenericResult::Status status) {
    switch (status) {
    case GenericResult::Status::ok:
        return CallStatus::ok;
    case GenericResult::Status::no_such_operation:
        return CallStatus::no_such_operation;
    case GenericResult::Status::bad_arguments:
        return CallStatus::bad_arguments;
    case GenericResult::Status::timeout:
        return CallStatus::timeout;
    default:
        return CallStatus::exception;
    }
}

} // namespace

ConsumerMirror::ConsumerMirror(link::Port port, std::chrono::milliseconds call_timeout)
    : port_(std::move(port)), call_timeout_(call_timeout) {}

const ConsumerMirror::Types& ConsumerMirror::types(std::string_view signature) {
    const std::lock_guard lock(mutex_);
    const auto known = types_.find(signature);
    if (known != types_.end()) return known->second;
    const auto operation = wire::parse_operation(signature);
    Types types{wire::parse_signature(operation.arguments), wire::parse_signature(operation.result)};
    return types_.emplace(signature, std::move(types)).first->second;
}

/// The partner has checked the same at connection; but it is another process.
std::string ConsumerMirror::check(const link::Request& request) const {
    if (port_.operations.empty()) return "";
    const auto known =
        std::find_if(port_.operations.begin(), port_.operations.end(),
                     [&](const auto& operation) { return operation.name == request.operation; });
    if (known == port_.operations.end()) return fmt::format("interface {} has no such operation", port_.type);
    if (wire::parse_operation(known->signature) == wire::parse_operation(request.signature)) return "";
    return fmt::format("the operation has signature '{}', not '{}'", known->signature, request.signature);
}

Answer ConsumerMirror::serve(const link::Request& request) {
    try {
        const std::string error = check(request);
        if (!error.empty()) return Answer::failure(CallStatus::bad_arguments, error);
        const Types& wanted = types(request.signature);
        auto result = generic_call(consumer_.getObject(), std::string(request.operation), wanted.arguments,
                                   wanted.result, request.arguments, call_timeout_);
        if (result.status == GenericResult::Status::ok) return {CallStatus::ok, std::move(result.results)};
        return Answer::failure(status_of(result.status), result.text);
    } catch (const wire::SignatureError& error) {
        return Answer::failure(CallStatus::bad_arguments, error.what());
    }
}

} // namespace tandem::interceptor

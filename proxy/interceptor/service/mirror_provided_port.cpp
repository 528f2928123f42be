// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/mirror_provided_port.hpp"

#include "proxy/interceptor/corba/generic_call.hpp"
#include "proxy/link/protocol/service_exception.hpp"

#include <fmt/format.h>

namespace tandem::interceptor {
namespace {

using link::CallStatus;
using link::Reply;

/// Signatures that requests of one interface may bring, since they come from another process.
constexpr std::size_t max_requested_types = 1024;

Reply make_reply(const GenericCallFailure& failure) {
    using Status = GenericCallFailure::Status;
    switch (failure.status) {
    case Status::no_such_operation:
        return Reply::failure(CallStatus::no_such_operation, failure.text);
    case Status::bad_arguments:
        return Reply::failure(CallStatus::bad_arguments, failure.text);
    case Status::bad_results:
        return link::refuse_results(failure.text);
    case Status::timeout:
        return Reply::failure(CallStatus::timeout, failure.text);
    case Status::unreachable:
        return Reply::failure(CallStatus::not_ready, "not ready: " + failure.text);
    default:
        return link::make_exception_reply(
            {failure.exception_id, failure.text, {failure.fields.begin(), failure.fields.end()}});
    }
}

} // namespace

MirrorProvidedPort::MirrorProvidedPort(link::Port port, std::chrono::milliseconds call_timeout)
    : port_(std::move(port)), operations_(port_.operations), call_timeout_(call_timeout) {
    for (const auto& [name, operation] : operations_)
        if (operation.problem.empty())
            known_.emplace_back(link::operation_id(name, operation.types.signature), &operation);
}

/// AdaptorComp has checked the same at connection, but it is another process and not trusted.
const wire::Operation* MirrorProvidedPort::find_operation(const link::Request& request, Reply& refusal) {
    // Without the IDL there is nothing to compare with: the CORBA object refuses what it does not know.
    if (operations_.empty()) return parse_request_types(request.signature, refusal);
    const auto* known = operations_.find(request.operation);
    if (known && known->problem.empty() && known->types.signature == request.signature) return &known->types;
    if (!known)
        refusal = Reply::failure(CallStatus::no_such_operation,
                                 fmt::format("interface {} has no such operation", port_.type));
    else
        refusal =
            Reply::failure(CallStatus::bad_arguments,
                           !known->problem.empty() ? known->problem
                                                   : fmt::format("the operation has signature '{}', not '{}'",
                                                                 known->types.signature, request.signature));
    return nullptr;
}

/// Parsing takes longer than converting a small call, so each signature is parsed once.
const wire::Operation* MirrorProvidedPort::parse_request_types(std::string_view signature, Reply& refusal) {
    const std::lock_guard lock(mutex_);
    const auto known = requested_types_.find(signature);
    if (known != requested_types_.end()) return known->second.get();
    try {
        if (requested_types_.size() == max_requested_types)
            throw wire::SignatureError("the peer has called with more than 1024 signatures");
        auto types = std::make_unique<wire::Operation>(wire::parse_operation(signature));
        return requested_types_.emplace(signature, std::move(types)).first->second.get();
    } catch (const wire::SignatureError& error) {
        refusal = Reply::failure(CallStatus::bad_arguments, error.what());
        return nullptr;
    }
}

void MirrorProvidedPort::leave_out(const std::string& why) {
    const std::lock_guard lock(mutex_);
    left_out_ = why;
}

std::string MirrorProvidedPort::why_left_out() {
    const std::lock_guard lock(mutex_);
    return CORBA::is_nil(consumer_.getObject()) ? left_out_ : "";
}

inline link::ReplyView MirrorProvidedPort::invoke(const std::string& name,
                                                  std::span<const std::byte> arguments,
                                                  const wire::Operation& operation,
                                                  wire::MessageBuffer& memory) {
    std::optional<GenericCallFailure> failure;
    if (const auto results = generic_call(consumer_.getObject(), name, operation, arguments, call_timeout_,
                                          memory, failure)) [[likely]]
        return {CallStatus::ok, *results};
    const std::string left_out = why_left_out();
    return copy_to(memory, left_out.empty() ? make_reply(*failure)
                                            : Reply::failure(CallStatus::no_such_operation, left_out));
}

std::optional<link::ReplyView> MirrorProvidedPort::serve_known(const link::KnownRequest& request,
                                                               wire::MessageBuffer& memory) {
    for (const auto& [id, operation] : known_)
        if (id == request.id.operation)
            return invoke(operation->name, request.arguments, operation->types, memory);
    return std::nullopt;
}

Reply MirrorProvidedPort::serve(const link::Request& request) {
    Reply refusal;
    const auto* operation = find_operation(request, refusal);
    if (!operation) return refusal;
    wire::MessageBuffer memory;
    return invoke(std::string(request.operation), request.arguments, *operation, memory).copy();
}

} // namespace tandem::interceptor

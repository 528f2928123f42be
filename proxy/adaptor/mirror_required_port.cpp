// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/mirror_required_port.hpp"

#include "proxy/adaptor/cdr_archive.hpp"
#include "proxy/adaptor/method_check.hpp"

#include <ProvidedServicePort.h>

#include <fmt/format.h>

#include <mutex>

namespace tandem::adaptor {

using link::CallStatus;
using link::Reply;

MirrorRequiredPort::MirrorRequiredPort(link::Port peer) : peer_(std::move(peer)) {}

std::string MirrorRequiredPort::bindProvided(ProvidedServicePort* provided) {
    const std::unique_lock lock(mutex_);
    signatures_.clear();
    provided_ = nullptr;
    if (!provided) return "";
    const std::string error = collect(*provided);
    if (error.empty()) provided_ = provided;
    return error;
}

std::string MirrorRequiredPort::collect(ProvidedServicePort& provided) {
    for (auto at = provided.getFirst(); at != provided.getEnd(); ++at)
        if (const auto signature = signature_of(*at->second)) signatures_[at->first] = *signature;
    for (const auto& wanted : peer_.operations) {
        const auto ours = signatures_.find(wanted.name);
        if (ours == signatures_.end())
            return fmt::format(
                "service port '{}': the peer requires operation '{}' ({}), which the connected port "
                "does not provide with types that can cross the link",
                peer_.name, wanted.name, wanted.signature);
        const auto error = check_method(peer_, ours->first, ours->second);
        if (!error.empty()) return error;
    }
    return "";
}

std::vector<link::ServiceOperation> MirrorRequiredPort::operations() const {
    const std::shared_lock lock(mutex_);
    std::vector<link::ServiceOperation> operations;
    for (const auto& [name, signature] : signatures_) operations.push_back({name, signature});
    return operations;
}

Reply MirrorRequiredPort::serve(const link::Request& request) {
    const std::shared_lock lock(mutex_);
    if (!provided_)
        return Reply::failure(CallStatus::no_such_operation, "no OPRoS component provides this service");
    const auto known = signatures_.find(std::string(request.operation));
    if (known == signatures_.end())
        return Reply::failure(CallStatus::no_such_operation, "the OPRoS component has no such method");
    if (known->second != request.signature)
        return Reply::failure(
            CallStatus::bad_arguments,
            fmt::format("the method has signature '{}', not '{}'", known->second, request.signature));
    return invoke(request);
}

Reply MirrorRequiredPort::invoke(const link::Request& request) {
    Reply reply;
    wire::CdrWriter writer(reply.bytes);
    CdrOarchive results(writer);
    CdrIarchive arguments{wire::CdrReader(request.arguments)};
    std::string name(request.operation);
    try {
        const ReturnType code = provided_->callService(name, arguments, results);
        if (code == OPROS_SUCCESS) return reply;
        return Reply::failure(CallStatus::exception, fmt::format("the OPRoS method returned {}", code));
    } catch (const opros::archive::archive_type_exception&) {
        return Reply::failure(CallStatus::bad_arguments, "the arguments do not decode");
    } catch (const std::exception& error) {
        return Reply::failure(CallStatus::exception, error.what());
    } catch (...) { // a component may throw anything; it must reach the caller as a reply, not end a worker
        return Reply::failure(CallStatus::exception,
                              "the OPRoS method threw something that is no std::exception");
    }
}

} // namespace tandem::adaptor

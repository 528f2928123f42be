// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/mirror_required_port.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/service/method_check.hpp"

#include <ProvidedServicePort.h>

#include <fmt/format.h>

#include <mutex>

namespace tandem::adaptor {

using link::CallStatus;
using link::Reply;

MirrorRequiredPort::MirrorRequiredPort(link::Port peer) : peer_(std::move(peer)) {}

/// Waits for calls that are being served: the port that they use may be destroyed after this function.
std::string MirrorRequiredPort::bindProvided(ProvidedServicePort* provided) {
    const std::unique_lock lock(mutex_);
    signatures_.clear();
    provided_ = nullptr;
    if (!provided) return "";
    std::string error = collect_signatures(*provided);
    if (error.empty())
        provided_ = provided;
    else
        signatures_.clear(); // the peer must not be offered what was refused
    return error;
}

std::string MirrorRequiredPort::collect_signatures(ProvidedServicePort& provided) {
    for (auto at = provided.getFirst(); at != provided.getEnd(); ++at)
        if (const auto signature = method_signature(*at->second)) signatures_[at->first] = *signature;
    // Methods that the peer does not require may have types that cannot cross: they are left out above.
    for (const auto& required : peer_.operations) {
        const auto provided_method = signatures_.find(required.name);
        if (provided_method == signatures_.end())
            return fmt::format(
                "service port '{}': the peer requires operation '{}' ({}), which the connected port "
                "does not provide with types that can cross the link",
                peer_.name, required.name, required.signature);
        auto error = check_method(peer_, provided_method->first, provided_method->second);
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
    // The peer checked the signature when the binding was published, but it is another process.
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
    } catch (...) {
        // A component may throw anything. The caller must learn of it, and the worker thread must survive it.
        return Reply::failure(CallStatus::exception,
                              "the OPRoS method threw something that is no std::exception");
    }
}

} // namespace tandem::adaptor

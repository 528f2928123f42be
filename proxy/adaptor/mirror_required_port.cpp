// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/mirror_required_port.hpp"

#include "proxy/adaptor/cdr_archive.hpp"
#include "proxy/adaptor/method_check.hpp"

#include <ProvidedServicePort.h>

#include <fmt/format.h>

#include <mutex>

namespace tandem::adaptor {

using link::Answer;
using link::CallStatus;

MirroredRequired::MirroredRequired(link::Port partner) : partner_(std::move(partner)) {}

std::string MirroredRequired::bindProvided(ProvidedServicePort* provided) {
    const std::unique_lock lock(mutex_);
    signatures_.clear();
    provided_ = nullptr;
    if (!provided) return "";
    const std::string error = collect(*provided);
    if (error.empty()) provided_ = provided;
    return error;
}

std::string MirroredRequired::collect(ProvidedServicePort& provided) {
    for (auto at = provided.getFirst(); at != provided.getEnd(); ++at)
        if (const auto signature = signature_of(*at->second)) signatures_[at->first] = *signature;
    for (const auto& wanted : partner_.operations) {
        const auto ours = signatures_.find(wanted.name);
        if (ours == signatures_.end())
            return fmt::format(
                "service port '{}': the partner requires operation '{}' ({}), which the connected port "
                "does not provide with types that can cross the link",
                partner_.name, wanted.name, wanted.signature);
        const auto error = check_method(partner_, ours->first, ours->second);
        if (!error.empty()) return error;
    }
    return "";
}

std::vector<link::ServiceOperation> MirroredRequired::operations() const {
    const std::shared_lock lock(mutex_);
    std::vector<link::ServiceOperation> operations;
    for (const auto& [name, signature] : signatures_) operations.push_back({name, signature});
    return operations;
}

Answer MirroredRequired::serve(const link::Request& request) {
    const std::shared_lock lock(mutex_);
    if (!provided_)
        return Answer::failure(CallStatus::no_such_operation, "no OPRoS component provides this service");
    const auto known = signatures_.find(std::string(request.operation));
    if (known == signatures_.end())
        return Answer::failure(CallStatus::no_such_operation, "the OPRoS component has no such method");
    if (known->second != request.signature)
        return Answer::failure(
            CallStatus::bad_arguments,
            fmt::format("the method has signature '{}', not '{}'", known->second, request.signature));
    return invoke(request);
}

Answer MirroredRequired::invoke(const link::Request& request) {
    Answer answer;
    wire::CdrWriter writer(answer.bytes);
    CdrOarchive results(writer);
    CdrIarchive arguments{wire::CdrReader(request.arguments)};
    std::string name(request.operation);
    try {
        const ReturnType code = provided_->callService(name, arguments, results);
        if (code == OPROS_SUCCESS) return answer;
        return Answer::failure(CallStatus::exception, fmt::format("the OPRoS method returned {}", code));
    } catch (const opros::archive::archive_type_exception&) {
        return Answer::failure(CallStatus::bad_arguments, "the arguments do not decode");
    } catch (const std::exception& error) {
        return Answer::failure(CallStatus::exception, error.what());
    } catch (...) { // a component may throw anything; it must reach the caller as an answer, not end a worker
        return Answer::failure(CallStatus::exception,
                               "the OPRoS method threw something that is no std::exception");
    }
}

} // namespace tandem::adaptor

// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/mirror_required_port.hpp"

#include "proxy/wire/signature_match.hpp"

#include <rtm/InterfaceSignatures.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace tandem::interceptor {
namespace {

/// The repository id that the consumer's _narrow() will ask for. Where the IDL is not known to this process, it
/// is put together from the type name as omniidl would; a pragma prefix cannot be guessed.
std::string repository_id(const std::string& type) {
    std::string known = RTC::InterfaceSignatures::repositoryId(type);
    if (!known.empty()) return known;
    std::string path = type;
    for (auto at = path.find("::"); at != std::string::npos; at = path.find("::")) path.replace(at, 2, "/");
    return "IDL:" + path + ":1.0";
}

/// Maps a failed reply to the CORBA system exception that tells the caller most about it. COMPLETED_NO: the
/// operation was refused before it ran; COMPLETED_MAYBE: it may have run before the failure.
[[noreturn]] void throw_system_exception(const link::Reply& reply) {
    using link::CallStatus;
    switch (reply.status) {
    case CallStatus::timeout:
        throw CORBA::TIMEOUT(0, CORBA::COMPLETED_MAYBE);
    case CallStatus::peer_died:
    case CallStatus::shut_down:
        throw CORBA::COMM_FAILURE(0, CORBA::COMPLETED_MAYBE);
    case CallStatus::overload:
        throw CORBA::NO_RESOURCES(0, CORBA::COMPLETED_NO);
    case CallStatus::no_such_operation:
        throw CORBA::BAD_OPERATION(0, CORBA::COMPLETED_NO);
    case CallStatus::bad_arguments:
        throw CORBA::BAD_PARAM(0, CORBA::COMPLETED_NO);
    default:
        throw CORBA::UNKNOWN(0, CORBA::COMPLETED_MAYBE);
    }
}

} // namespace

MirrorRequiredPort::MirrorRequiredPort(link::Port port, link::Link& link,
                                       std::chrono::milliseconds call_timeout)
    : port_(std::move(port)), link_(link), call_timeout_(call_timeout),
      servant_(repository_id(port_.type), *this) {
    for (const auto& operation : port_.operations)
        // '?' stands for a type without a signature: such an operation cannot cross the link.
        if (operation.signature.find('?') == std::string::npos) add_operation(operation);
}

void MirrorRequiredPort::add_operation(const link::ServiceOperation& operation) {
    const auto signature = wire::parse_operation_signature(operation.signature);
    auto& entry = operations_[operation.name];
    if (entry) retired_.push_back(std::move(entry));
    entry = std::make_unique<Operation>(Operation{wire::parse_signature(signature.arguments),
                                                  wire::parse_signature(signature.result),
                                                  signature.arguments + ":" + signature.result});
}

std::string MirrorRequiredPort::bind(const link::control::ServiceBinding& binding) {
    const std::lock_guard lock(mutex_);
    const bool idl_known = !port_.operations.empty();
    for (const auto& offered : binding.operations) {
        const auto known = operations_.find(offered.name);
        if (known != operations_.end() && known->second->signature == offered.signature) continue;
        if (!idl_known) {
            add_operation(offered); // the OPRoS component's methods are the only description that there is
        } else if (known != operations_.end()) {
            return fmt::format(
                "service port '{}': operation '{}' of interface {} has signature '{}', the OPRoS method "
                "has '{}'",
                port_.name, offered.name, port_.type, known->second->signature, offered.signature);
        } // a method that the IDL does not have is not needed
    }
    return "";
}

const CallTarget::Operation* MirrorRequiredPort::find_operation(const char* name) {
    const std::lock_guard lock(mutex_);
    const auto found = operations_.find(name);
    return found == operations_.end() ? nullptr : found->second.get();
}

std::vector<std::byte> MirrorRequiredPort::call(const char* name, const Operation& operation,
                                                std::span<const std::byte> arguments) {
    auto reply = link_.call({port_.name, name, operation.signature, arguments}, call_timeout_);
    if (reply.status == link::CallStatus::ok) return std::move(reply.bytes);
    // A CORBA system exception carries no text, so it is logged here.
    if (!reply.bytes.empty() && failed_calls_.should_log())
        spdlog::warn("service '{}.{}': {} ({} failed calls so far)", port_.name, name, reply.text(),
                     failed_calls_.count());
    throw_system_exception(reply);
}

} // namespace tandem::interceptor

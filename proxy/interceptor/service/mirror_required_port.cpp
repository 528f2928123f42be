// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/mirror_required_port.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/corba/generic_user_exception.hpp"
#include "proxy/interceptor/corba/typecode.hpp"
#include "proxy/interceptor/service/interface_operations.hpp"
#include "proxy/link/protocol/service_exception.hpp"

#include <rtm/InterfaceSignatures.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tandem::interceptor {
namespace {

/// The repository id that the consumer's _narrow() will ask for; a prefix of an IDL that this process does not know
/// cannot be guessed.
std::string interface_id(const std::string& type) {
    const std::string known = RTC::InterfaceSignatures::repositoryId(type);
    return known.empty() ? repository_id(type) : known;
}

/// Maps a failed reply to the CORBA system exception that tells the caller most about it. COMPLETED_NO: the
/// operation was refused before it ran; COMPLETED_MAYBE: it may have run before the failure.
[[noreturn]] void throw_system_exception(const link::Reply& reply) {
    using link::CallStatus;
    switch (reply.status) {
    case CallStatus::not_ready:
        throw CORBA::TRANSIENT(0, CORBA::COMPLETED_NO);
    case CallStatus::timeout:
        throw CORBA::TIMEOUT(0, CORBA::COMPLETED_MAYBE);
    case CallStatus::peer_died:
    case CallStatus::shut_down:
        throw CORBA::COMM_FAILURE(0, CORBA::COMPLETED_MAYBE);
    case CallStatus::overload:
        throw CORBA::NO_RESOURCES(0, CORBA::COMPLETED_NO);
    case CallStatus::no_such_operation:
        throw CORBA::BAD_OPERATION(0, CORBA::COMPLETED_NO);
    case CallStatus::cancelled:
        throw CORBA::NO_RESPONSE(0, CORBA::COMPLETED_MAYBE);
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
      servant_(interface_id(port_.type), *this) {
    add_table(std::make_unique<const Table>(port_.name, port_.operations));
}

MirrorRequiredPort::Table::Table(const std::string& port,
                                 const std::vector<link::ServiceOperation>& described)
    : operations(described) {
    for (const auto& [name, operation] : operations)
        callables.push_back({operation.types, name, operation.problem,
                             link::RequestHead(port, name, operation.types.signature)});
}

void MirrorRequiredPort::add_table(std::unique_ptr<const Table> table) {
    table_.store(table.get(), std::memory_order_release);
    tables_.push_back(std::move(table));
}

void MirrorRequiredPort::bind(const link::control::ServiceBinding& binding) {
    // Without the IDL, the OPRoS component's methods are the only description that there is.
    if (port_.operations.empty()) {
        auto table = std::make_unique<const Table>(port_.name, binding.operations);
        const std::lock_guard lock(mutex_);
        if (!binding.operations.empty() && table->operations != tables_.back()->operations)
            add_table(std::move(table));
    }
    ready_ = !binding.operations.empty();
}

const wire::Operation* MirrorRequiredPort::find_operation(const char* name) {
    const std::string_view wanted = name;
    for (const Callable& callable : table_.load(std::memory_order_acquire)->callables)
        if (callable.name == wanted) {
            if (!callable.problem.empty()) refuse(callable);
            return &callable;
        }
    return nullptr;
}

void MirrorRequiredPort::refuse(const Callable& callable) {
    log_failure(callable.name.c_str(), callable.problem);
    throw CORBA::NO_IMPLEMENT(0, CORBA::COMPLETED_NO);
}

// A CORBA system exception carries no text, so it is logged here.
void MirrorRequiredPort::log_failure(const char* name, const std::string& text) {
    if (failed_calls_.should_log())
        log::warn("service '{}.{}': {} ({} failed calls so far)", port_.name, name, text,
                  failed_calls_.count());
}

/// Without the IDL, the operations are not known before a component provides them.
void MirrorRequiredPort::unknown_operation(const char* name) {
    const auto& callables = table_.load(std::memory_order_acquire)->callables;
    if (callables.empty()) {
        log_failure(name, "not ready: no OPRoS component provides it yet");
        throw CORBA::TRANSIENT(0, CORBA::COMPLETED_NO);
    }
    std::vector<std::string> names;
    for (const auto& callable : callables) names.push_back(callable.name);
    log_failure(name, fmt::format("there is no such operation, only: {}", fmt::join(names, ", ")));
}

void MirrorRequiredPort::value_refused(const char* name, const char* what, const std::string& reason) {
    log_failure(name, fmt::format("{} cannot cross: {}", what, reason));
}

bool MirrorRequiredPort::may_be(const char* repository_id) const {
    return is_named(repository_id, port_.type);
}

// The operations are those that find_operation() has returned.
void MirrorRequiredPort::put_head(const wire::Operation& operation, wire::CdrWriter& out) {
    static_cast<const Callable&>(operation).head.put(out);
}

std::span<const std::byte> MirrorRequiredPort::call(const char* name, const wire::Operation& operation,
                                                    std::span<const std::byte> request,
                                                    wire::MessageBuffer& memory) {
    const auto reply = operation.oneway
                           ? copy_to(memory, link_.send(*link::decode_request(request), call_timeout_))
                           : link_.call(request, call_timeout_, memory);
    if (reply.status != link::CallStatus::ok) throw_failure(name, operation, reply.copy());
    return reply.bytes;
}

void MirrorRequiredPort::throw_failure(const char* name, const wire::Operation& operation,
                                       const link::Reply& reply) {
    std::string text = reply.text();
    if (reply.status == link::CallStatus::user_exception) {
        auto exception = link::decode_service_exception(reply.bytes);
        if (const auto* declared = operation.find_exception(exception.id))
            throw GenericUserException(*declared, std::move(exception.fields));
        if (exception.id == link::refused_results_id) {
            log_failure(name, exception.text);
            throw CORBA::MARSHAL(0, CORBA::COMPLETED_YES);
        }
        text = fmt::format("{} ({}, which the operation does not declare)", exception.text, exception.id);
    }
    if (!text.empty()) log_failure(name, text);
    throw_system_exception(reply);
}

} // namespace tandem::interceptor

// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/generic_servant.hpp"

#include "proxy/interceptor/corba/call_stream.hpp"
#include "proxy/interceptor/corba/direct_identity.hpp"
#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"

#include <omniORB4/callDescriptor.h>
#include <omniORB4/callHandle.h>
#include <omniORB4/proxyFactory.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace tandem::interceptor {
namespace {

/// Converts the arguments or the results of a call. A value that cannot cross is CORBA::MARSHAL for the caller.
template <class Function>
auto convert(CallTarget& target, const char* name, bool results, const Function& function) {
    try {
        return function();
    } catch (const CORBA::SystemException& error) {
        target.value_refused(name, results ? "its result" : "an argument", reason_of(error));
        throw CORBA::MARSHAL(0, results ? CORBA::COMPLETED_YES : CORBA::COMPLETED_NO);
    }
}

/// One call from another process through the ORB, which calls these functions in the order arguments, run, results.
class Upcall final : public omniCallDescriptor {
  public:
    /// `exceptions`: the ids of user exceptions that the ORB lets pass; any other becomes CORBA::UNKNOWN.
    Upcall(const char* name, const wire::Operation& operation, CallTarget& target,
           std::span<const char*> exceptions)
        : omniCallDescriptor(&Upcall::run, name, std::char_traits<char>::length(name) + 1, operation.oneway,
                             exceptions.data(), static_cast<int>(exceptions.size()), 1),
          operation_(operation), target_(target) {}

    // Arguments are converted before the target is called, so a malformed request never reaches it.
    void unmarshalArguments(cdrStream& stream) override {
        wire::CdrWriter writer(buffer_);
        target_.put_head(operation_, writer);
        convert(target_, op(), false, [&] { to_cdr(operation_.request, stream, writer); });
        request_ = writer.written();
    }
    void marshalReturnedValues(cdrStream& stream) override {
        wire::CdrReader reader(results_);
        convert(target_, op(), true, [&] { from_cdr(operation_.reply, reader, stream); });
    }

  private:
    static void run(omniCallDescriptor* descriptor, omniServant*) {
        auto* self = static_cast<Upcall*>(descriptor);
        self->results_ =
            self->target_.call(self->op(), self->operation_, self->request_, self->results_memory_);
    }

    const wire::Operation& operation_;
    CallTarget& target_;
    wire::MessageBuffer buffer_;
    wire::MessageBuffer results_memory_;
    std::span<const std::byte> request_, results_; ///< in the buffers
};

/// Encodes the request of a call within this process: the head, and the arguments of the stub.
std::span<const std::byte> encode_request(omniCallDescriptor& call, const wire::Operation& operation,
                                          CallTarget& target, CallStream& stream,
                                          wire::MessageBuffer& memory) {
    wire::CdrWriter writer(memory);
    target.put_head(operation, writer);
    if (operation.plain_request) [[likely]] {
        stream.write_to(memory, writer.size());
        call.marshalArguments(stream);
        return stream.written();
    }
    cdrMemoryStream other;
    call.marshalArguments(other);
    to_cdr(operation.request, other, writer);
    return writer.written();
}

void decode_results(omniCallDescriptor& call, const wire::Operation& operation, CallStream& stream,
                    std::span<const std::byte> results) {
    if (operation.plain_reply) [[likely]] {
        stream.read_from(results);
        return call.unmarshalReturnedValues(stream);
    }
    cdrMemoryStream other;
    wire::CdrReader reader(results);
    from_cdr(operation.reply, reader, other);
    call.unmarshalReturnedValues(other);
}

/// Whether every CORBA object has the operation. The names of attributes begin with an underscore, too.
bool is_of_every_object(const char* name) {
    constexpr std::array<std::string_view, 6> names = {"_is_a",      "_non_existent",  "_interface",
                                                       "_component", "_repository_id", "_implementation"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Lets the stub throw the exception, as if it had come from another process.
void throw_to_stub(const CORBA::UserException& exception, omniCallDescriptor& call) {
    cdrMemoryStream stream;
    exception._NP_marshal(stream);
    int size = 0;
    const char* const id = exception._NP_repoId(&size);
    call.userException(stream, nullptr, id);
}

} // namespace

GenericServant::GenericServant(std::string repository_id, CallTarget& target)
    : repository_id_(std::move(repository_id)), target_(target) {}

_CORBA_Boolean GenericServant::_dispatch(omniCallHandle& handle) {
    const char* name = handle.operation_name();
    const auto* operation = target_.find_operation(name);
    if (!operation) { // the ORB handles _is_a and similar operations, and answers BAD_OPERATION to all others
        if (!is_of_every_object(name)) target_.unknown_operation(name);
        return 0;
    }
    if (auto* call = handle.call_desc(); call && !handle.mainthread_mu() && !handle.postinvoke_hook()) {
        DirectIdentity::give(*call, *handle.localId(), *this);
        execute(*operation, *call);
        return 1;
    }
    Upcall upcall(name, *operation, target_, exception_ids(*operation));
    handle.upcall(this, upcall);
    return 1;
}

/// The ORB reads the list after _dispatch() has ended by an exception, so it is not in the frame of the call.
std::span<const char*> GenericServant::exception_ids(const wire::Operation& operation) {
    if (operation.exceptions.empty()) return {};
    const std::lock_guard lock(exception_ids_mutex_);
    const auto [known, is_new] = exception_ids_.try_emplace(&operation);
    if (is_new)
        for (const auto& exception : operation.exceptions) known->second.push_back(exception.id.c_str());
    return known->second;
}

bool GenericServant::call_from_here(omniCallDescriptor& call) {
    const auto* operation = target_.find_operation(call.op());
    if (!operation) return false;
    try {
        execute(*operation, call);
    } catch (const std::exception&) { // for example out of memory; the ORB converts it in the same way
        throw CORBA::UNKNOWN(0, CORBA::COMPLETED_MAYBE);
    }
    return true;
}

void GenericServant::execute(const wire::Operation& operation, omniCallDescriptor& call) {
    wire::MessageBuffer request, results;
    CallStream stream;
    try {
        const auto encoded = convert(target_, call.op(), false, [&] {
            return encode_request(call, operation, target_, stream, request);
        });
        const auto replied = target_.call(call.op(), operation, encoded, results);
        convert(target_, call.op(), true, [&] { decode_results(call, operation, stream, replied); });
    } catch (const CORBA::UserException& exception) {
        throw_to_stub(exception, call);
    }
}

_CORBA_Boolean GenericServant::_is_a(const char* repository_id) {
    if (repository_id_ == repository_id || omni::strMatch(repository_id, CORBA::Object::_PD_repoId))
        return true;
    const auto* const stubs = omni::proxyObjectFactory::lookup(repository_id_.c_str());
    return (stubs != nullptr && stubs->is_a(repository_id)) || target_.may_be(repository_id);
}

void* GenericServant::_ptrToInterface(const char* repository_id) {
    // Only CORBA::Object: there is no compiled skeleton that a co-located caller could call directly, so all
    // callers go through _dispatch(). Any pointer other than nullptr means "yes" to the ORB.
    return omni::strMatch(repository_id, CORBA::Object::_PD_repoId) ? reinterpret_cast<void*>(1) : nullptr;
}

const char* GenericServant::_mostDerivedRepoId() { return repository_id_.c_str(); }

} // namespace tandem::interceptor

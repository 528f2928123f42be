// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/generic_call.hpp"

#include "proxy/interceptor/corba/local_call.hpp"
#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"

#include <omniORB4/IOP_C.h>
#include <omniORB4/callDescriptor.h>
#include <omniORB4/omniObjRef.h>

#include <fmt/format.h>

namespace tandem::interceptor {
namespace {

/// One call of a remote object through the ORB, made as omniidl's stubs make it.
class Call final : public omniCallDescriptor {
  public:
    Call(const std::string& name, const wire::Operation& operation, std::span<const std::byte> arguments,
         wire::MessageBuffer& memory)
        : omniCallDescriptor(nullptr, name.c_str(), name.size() + 1, operation.oneway, nullptr, 0, 0),
          operation_(operation), arguments_(arguments), memory_(memory) {}

    void marshalArguments(cdrStream& stream) override {
        // Starts from the beginning each time, because the ORB marshals again when it repeats a request.
        wire::CdrReader reader(arguments_);
        from_cdr(operation_.request, reader, stream);
    }
    void unmarshalReturnedValues(cdrStream& stream) override { read(operation_.reply, stream); }
    /// `client` is null when the object is in this process; then the ORB has marshalled what the servant threw.
    void userException(cdrStream& stream, _OMNI_NS(IOP_C) * client, const char* repository_id) override {
        exception = repository_id;
        // Only the id is known of an exception that the operation does not declare.
        if (const auto* declared = operation_.find_exception(exception)) read(declared->fields, stream);
        if (client) client->RequestCompleted(1);
    }

    std::span<const std::byte> results; ///< in the memory passed to the constructor
    std::string exception;

  private:
    void read(const wire::Type& message, cdrStream& stream) {
        wire::CdrWriter writer(memory_);
        convert_results([&] { to_cdr(message, stream, writer); });
        results = writer.written();
    }

    const wire::Operation& operation_;
    std::span<const std::byte> arguments_;
    wire::MessageBuffer& memory_;
};

using Status = GenericCallFailure::Status;
using Results = std::optional<std::span<const std::byte>>;

GenericCallFailure failure_of(Status status, const std::string& operation, std::string_view what,
                              std::string exception_id = "") {
    return {status, fmt::format("operation '{}': {}", operation, what), std::move(exception_id)};
}

/// Converts an exception that the servant has thrown in a call within the process.
GenericCallFailure failure_of(const CORBA::UserException& exception, const std::string& name,
                              const wire::Operation& operation, wire::MessageBuffer& memory) {
    int size = 0;
    const std::string id = exception._NP_repoId(&size);
    auto failure = failure_of(Status::exception, name, id, id);
    const auto* declared = operation.find_exception(id);
    if (!declared) return failure;
    cdrMemoryStream stream;
    exception._NP_marshal(stream);
    wire::CdrWriter writer(memory);
    convert_results([&] { to_cdr(declared->fields, stream, writer); });
    failure.fields = writer.written();
    return failure;
}

Results call_by_orb(CORBA::Object_ptr object, const std::string& name, const wire::Operation& operation,
                    std::span<const std::byte> arguments, std::chrono::milliseconds timeout,
                    wire::MessageBuffer& memory, std::optional<GenericCallFailure>& failure) {
    Call call(name, operation, arguments, memory);
    // The limit applies to this object reference, not to the process, because other components choose their own limits.
    omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(timeout.count()));
    object->_PR_getobj()->_invoke(call);
    if (call.exception.empty()) return call.results;
    failure = failure_of(Status::exception, name, call.exception, call.exception);
    failure->fields = call.results;
    return std::nullopt;
}

/// Describes the system exception that is being handled.
GenericCallFailure describe_exception(const std::string& name) try {
    throw;
} catch (const CORBA::BAD_OPERATION&) {
    return failure_of(Status::no_such_operation, name, "the CORBA object has no such operation");
} catch (const CORBA::MARSHAL& ex) {
    const bool has_run = ex.completed() == CORBA::COMPLETED_YES;
    return failure_of(
        has_run ? Status::bad_results : Status::bad_arguments, name,
        fmt::format("{} cannot cross: {}", has_run ? "its result" : "an argument", reason_of(ex)));
} catch (const CORBA::TIMEOUT&) {
    return failure_of(Status::timeout, name, "the CORBA object did not answer in time");
} catch (const CORBA::SystemException& ex) {
    // These three mean that nobody executed the call; all others come from the object itself.
    const bool gone = dynamic_cast<const CORBA::TRANSIENT*>(&ex) ||
                      dynamic_cast<const CORBA::COMM_FAILURE*>(&ex) ||
                      dynamic_cast<const CORBA::OBJECT_NOT_EXIST*>(&ex);
    return failure_of(gone ? Status::unreachable : Status::exception, name, ex._name(), ex._rep_id());
}

} // namespace

Results generic_call(CORBA::Object_ptr object, const std::string& name, const wire::Operation& operation,
                     std::span<const std::byte> arguments, std::chrono::milliseconds timeout,
                     wire::MessageBuffer& memory, std::optional<GenericCallFailure>& failure) {
    if (CORBA::is_nil(object)) {
        failure = failure_of(Status::unreachable, name, "the provider is not connected");
        return std::nullopt;
    }
    try {
        try {
            if (const auto results =
                    call_local(*object->_PR_getobj(), name.c_str(), operation, arguments, memory)) [[likely]]
                return results;
            return call_by_orb(object, name, operation, arguments, timeout, memory, failure);
        } catch (const CORBA::UserException& exception) {
            failure = failure_of(exception, name, operation, memory);
        }
    } catch (const CORBA::SystemException&) { // also of the fields of a user exception
        failure = describe_exception(name);
    }
    return std::nullopt;
}

} // namespace tandem::interceptor

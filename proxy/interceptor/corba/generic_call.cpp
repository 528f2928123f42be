// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/generic_call.hpp"

#include "proxy/interceptor/corba/transcoder.hpp"

#include <omniORB4/IOP_C.h>
#include <omniORB4/callDescriptor.h>
#include <omniORB4/omniObjRef.h>

#include <fmt/format.h>

namespace tandem::interceptor {
namespace {

/// One call on its way through the ORB, as omniidl's stubs make it.
class Call final : public omniCallDescriptor {
  public:
    Call(const std::string& name, const wire::Operation& operation, std::span<const std::byte> arguments)
        : omniCallDescriptor(nullptr, name.c_str(), name.size() + 1, operation.oneway, nullptr, 0, 0),
          operation_(operation), arguments_(arguments) {}

    void marshalArguments(cdrStream& stream) override {
        // From the beginning each time: the ORB marshals again when it repeats a request.
        wire::CdrReader reader(arguments_);
        from_cdr(operation_.request, reader, stream);
    }
    void unmarshalReturnedValues(cdrStream& stream) override {
        wire::CdrWriter writer(results);
        to_cdr(operation_.reply, stream, writer);
    }
    /// `client` is null when the object is in this process; then the ORB has marshalled what the servant threw.
    void userException(cdrStream& stream, _OMNI_NS(IOP_C) * client, const char* repository_id) override {
        exception = repository_id;
        // Of an exception that the operation does not declare, only the id is known.
        if (const auto* declared = operation_.find_exception(exception)) {
            wire::CdrWriter writer(results);
            to_cdr(declared->fields, stream, writer);
        }
        if (client) client->RequestCompleted(1);
    }

    std::vector<std::byte> results = wire::take_spare_bytes();
    std::string exception;

  private:
    const wire::Operation& operation_;
    std::span<const std::byte> arguments_;
};

using Status = GenericCallResult::Status;

GenericCallResult failure(Status status, const std::string& operation, std::string_view what,
                          std::string exception_id = "") {
    return {status, {}, fmt::format("operation '{}': {}", operation, what), std::move(exception_id)};
}

} // namespace

[[gnu::hot]] GenericCallResult generic_call(CORBA::Object_ptr object, const std::string& name,
                                            const wire::Operation& operation,
                                            std::span<const std::byte> arguments,
                                            std::chrono::milliseconds timeout) {
    if (CORBA::is_nil(object)) return failure(Status::unreachable, name, "the provider is not connected");
    omniObjRef* reference = object->_PR_getobj();
    Call call(name, operation, arguments);
    try {
        // Of this object reference, not of the process: other components choose their own bounds.
        omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(timeout.count()));
        reference->_invoke(call);
    } catch (const CORBA::BAD_OPERATION&) {
        return failure(Status::no_such_operation, name, "the CORBA object has no such operation");
    } catch (const CORBA::MARSHAL&) {
        return failure(Status::bad_arguments, name, "arguments or result do not fit the CORBA object's");
    } catch (const CORBA::TIMEOUT&) {
        return failure(Status::timeout, name, "the CORBA object did not answer in time");
    } catch (const CORBA::SystemException& ex) {
        // These three mean that nobody executed the call; all others come from the object itself.
        const bool gone = dynamic_cast<const CORBA::TRANSIENT*>(&ex) ||
                          dynamic_cast<const CORBA::COMM_FAILURE*>(&ex) ||
                          dynamic_cast<const CORBA::OBJECT_NOT_EXIST*>(&ex);
        return failure(gone ? Status::unreachable : Status::exception, name, ex._name(), ex._rep_id());
    }
    if (call.exception.empty()) return {Status::ok, std::move(call.results), {}, {}};
    auto thrown = failure(Status::exception, name, call.exception, call.exception);
    thrown.results = std::move(call.results);
    return thrown;
}

} // namespace tandem::interceptor

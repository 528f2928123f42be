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
    Call(const std::string& operation, const wire::Type& arguments_type, const wire::Type& result_type,
         std::span<const std::byte> arguments)
        : omniCallDescriptor(nullptr, operation.c_str(), operation.size() + 1, 0, nullptr, 0, 0),
          arguments_type_(arguments_type), result_type_(result_type), arguments_(arguments) {}

    void marshalArguments(cdrStream& stream) override {
        // From the beginning each time: the ORB marshals again when it repeats a request.
        wire::CdrReader reader(arguments_);
        from_cdr(arguments_type_, reader, stream);
    }
    void unmarshalReturnedValues(cdrStream& stream) override {
        wire::CdrWriter writer(results);
        to_cdr(result_type_, stream, writer);
    }
    // Reading the exception's members would need its type; the repository id says enough for a message.
    void userException(cdrStream&, _OMNI_NS(IOP_C) * client, const char* repository_id) override {
        exception = repository_id;
        if (client) client->RequestCompleted(1);
    }

    std::vector<std::byte> results;
    std::string exception;

  private:
    const wire::Type& arguments_type_;
    const wire::Type& result_type_;
    std::span<const std::byte> arguments_;
};

using Status = GenericCallResult::Status;

GenericCallResult failure(Status status, const std::string& operation, std::string_view what) {
    return {status, {}, fmt::format("operation '{}': {}", operation, what)};
}

} // namespace

GenericCallResult generic_call(CORBA::Object_ptr object, const std::string& operation,
                               const wire::Type& arguments_type, const wire::Type& result_type,
                               std::span<const std::byte> arguments, std::chrono::milliseconds timeout) {
    if (CORBA::is_nil(object))
        return failure(Status::unreachable, operation, "the provider is not connected");
    omniObjRef* reference = object->_PR_getobj();
    Call call(operation, arguments_type, result_type, arguments);
    try {
        // Of this object reference, not of the process: other components choose their own bounds.
        omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(timeout.count()));
        reference->_invoke(call);
    } catch (const CORBA::BAD_OPERATION&) {
        return failure(Status::no_such_operation, operation, "the CORBA object has no such operation");
    } catch (const CORBA::MARSHAL&) {
        return failure(Status::bad_arguments, operation, "arguments or result do not fit the CORBA object's");
    } catch (const CORBA::TIMEOUT&) {
        return failure(Status::timeout, operation, "the CORBA object did not answer in time");
    } catch (const CORBA::SystemException& ex) {
        // These three mean that nobody executed the call; all others come from the object itself.
        const bool gone = dynamic_cast<const CORBA::TRANSIENT*>(&ex) ||
                          dynamic_cast<const CORBA::COMM_FAILURE*>(&ex) ||
                          dynamic_cast<const CORBA::OBJECT_NOT_EXIST*>(&ex);
        return failure(gone ? Status::unreachable : Status::exception, operation, ex._name());
    } catch (const CORBA::UserException& ex) {
        // A co-located servant's exception comes straight through; a remote one's to Call::userException().
        return failure(Status::exception, operation, ex._rep_id());
    }
    if (!call.exception.empty()) return failure(Status::exception, operation, call.exception);
    return {Status::ok, std::move(call.results), {}};
}

} // namespace tandem::interceptor

// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/call/object_call.hpp"
#include <algorithm>
#include <cstring>
#include <new>
#include <objectTable.h>
#include <omniORB4/IOP_S.h>
#include <omniORB4/callDescriptor.h>
#include <omniORB4/callHandle.h>
#include <omniORB4/minorCode.h>
#include <omniORB4/omniObjRef.h>
#include <vector>

namespace RTC {
namespace {

void begin_reply(CallStream& reply, ReplyKind kind) {
    reply.rewindPtrs();
    static_cast<CORBA::ULong>(kind) >>= reply;
}

/// The request of a call in shared memory: what is GIOP_S for one that came by a socket.
class Request final : public omni::IOP_S {
  public:
    Request(const char* operation, CallStream& arguments, CallStream& reply)
        : operation_(operation), arguments_(arguments), reply_(reply) {}

    const char* operation_name() const override { return operation_; }
    cdrStream& getStream() override { return arguments_; }
    void ReceiveRequest(omniCallDescriptor& call) override {
        call_ = &call;
        exceptions_.assign(call.user_excns(), call.user_excns() + std::max(call.n_user_excns(), 0));
        call.unmarshalArguments(arguments_);
        arguments_.clearValueTracker();
        reply_.set_completion(CORBA::COMPLETED_MAYBE);
    }
    void SkipRequestBody() override {}
    void SendReply() override {
        reply_.set_completion(CORBA::COMPLETED_YES);
        begin_reply(reply_, ReplyKind::results);
        call_->marshalReturnedValues(reply_);
        reply_.clearValueTracker();
    }
    /// Called for servants without a skeleton, which do not throw.
    void SendException(CORBA::Exception* exception) override {
        if (const auto* system = CORBA::SystemException::_downcast(exception))
            write(*system);
        else
            write_user(*exception);
    }

    void write(const CORBA::SystemException& exception) {
        begin_reply(reply_, ReplyKind::system_exception);
        int size = 0;
        reply_.marshalRawString(exception._NP_repoId(&size));
        exception.minor() >>= reply_;
        static_cast<CORBA::ULong>(exception.completed()) >>= reply_;
    }
    /// An exception that the operation does not declare is UNKNOWN to the caller.
    void write(const CORBA::UserException& exception) {
        int size = 0;
        const char* const id = exception._NP_repoId(&size);
        const bool is_declared =
            std::any_of(exceptions_.begin(), exceptions_.end(),
                        [&](const char* declared) { return std::strcmp(declared, id) == 0; });
        if (is_declared)
            write_user(exception);
        else
            write_unknown();
    }
    void write_unknown() { write(CORBA::UNKNOWN(omni::UNKNOWN_UserException, completed())); }
    CORBA::CompletionStatus completed() { return static_cast<CORBA::CompletionStatus>(reply_.completion()); }

  private:
    void write_user(const CORBA::Exception& exception) {
        begin_reply(reply_, ReplyKind::user_exception);
        int size = 0;
        reply_.marshalRawString(exception._NP_repoId(&size));
        exception._NP_marshal(reply_);
        reply_.clearValueTracker();
    }

    const char* const operation_;
    CallStream& arguments_;
    CallStream& reply_;
    omniCallDescriptor* call_ = nullptr; // from ReceiveRequest() to SendReply()
    // Copied: a servant without a skeleton may have the list in its frame, which ends before the exception arrives here.
    std::vector<const char*> exceptions_;
};

/// Returns false if the object is not active.
bool dispatch(omniObjRef& reference, Request& request) {
    omniCallHandle handle(&request, omni_thread::self());
    omni::internalLock->lock(); // dispatch() below returns without it
    omniIdentity& identity = *reference._identity();
    omniLocalIdentity* object =
        identity.keysize() < 0
            ? nullptr
            : omniObjTable::locateActive(identity.key(), identity.keysize(),
                                         omni::hash(identity.key(), identity.keysize()), true);
    if (object == nullptr) {
        omni::internalLock->unlock();
        return false;
    }
    object->dispatch(handle);
    return true;
}

/// Throws what the servant throws, except user exceptions, and a system exception if the results or a user exception
/// cannot be encoded.
void call_or_write_user_exception(omniObjRef& reference, Request& request, CallStream& reply) {
    try {
        if (!dispatch(reference, request)) begin_reply(reply, ReplyKind::not_here);
    } catch (const CORBA::UserException& exception) {
        request.write(exception);
    } catch (omniORB::LOCATION_FORWARD& forward) {
        const CORBA::Object_var released(forward.get_obj());
        begin_reply(reply, ReplyKind::not_here);
    }
}

} // namespace

void call_object(CORBA::Object_ptr object, const char* operation, CallStream& arguments, CallStream& reply) {
    Request request(operation, arguments, reply);
    try {
        call_or_write_user_exception(*object->_PR_getobj(), request, reply);
    } catch (const CORBA::SystemException& exception) {
        request.write(exception);
    } catch (const std::bad_alloc&) {
        request.write(CORBA::NO_MEMORY(omni::NO_MEMORY_BadAlloc, request.completed()));
    } catch (...) { // a servant is a user's code and may throw any type
        request.write_unknown();
    }
}

} // namespace RTC

// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/call/call_identity.hpp"
#include "host/rtm/runtime/transport/call/call_sender.hpp"
#include <omniORB4/callDescriptor.h>
#include <omniORB4/omniObjRef.h>
#include <remoteIdentity.h>

namespace RTC {
namespace {

/// Keeps an identity. Made with the ORB's internal lock held, destroyed without.
class Kept {
  public:
    explicit Kept(omniIdentity& identity) : identity_(identity) { identity_.gainRef(); }
    ~Kept() {
        const omni_tracedmutex_lock lock(*omni::internalLock);
        identity_.loseRef();
    }
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;

  private:
    omniIdentity& identity_;
};

/// The identity of an object in another process whose calls go through shared memory: omniORB uses it to decide how to call
/// a reference. Its functions are called with the ORB's internal lock held.
class CallIdentity final : public omniIdentity {
  public:
    CallIdentity(omniIdentity& remote, std::shared_ptr<CallSender> sender)
        : omniIdentity(remote.key(), remote.keysize()), remote_(remote), sender_(std::move(sender)) {
        remote_.gainRef();
    }

    void dispatch(omniCallDescriptor& call) override {
        if (call.op() == nullptr) return remote_.dispatch(call); // only asks whether the object exists
        // From the unlock on, this identity may be deleted by another thread that gives the reference another one.
        omniIdentity& remote = remote_;
        const Kept kept(remote);
        const std::shared_ptr<CallSender> sender = sender_;
        omni::internalLock->unlock();
        if (sender->call(call)) return;
        omni::internalLock->lock();
        remote.dispatch(call);
    }
    void gainRef(omniObjRef*) override { ++references_; }
    void loseRef(omniObjRef*) override {
        if (--references_ == 0) delete this;
    }
    CORBA::Boolean inThisAddressSpace() override { return false; }
    void disconnect() override { remote_.disconnect(); }
    void* ptrToClass(int* id) override {
        return id == &omniIdentity::_classid ? static_cast<omniIdentity*>(this) : nullptr;
    }

  private:
    ~CallIdentity() override { remote_.loseRef(); }
    static CORBA::Boolean is_equal(const omniIdentity* a, const omniIdentity* b) {
        return static_cast<const CallIdentity*>(a)->remote_.is_equivalent(
            &static_cast<const CallIdentity*>(b)->remote_);
    }
    equivalent_fn get_real_is_equivalent() const override { return is_equal; }

    omniIdentity& remote_; // kept
    const std::shared_ptr<CallSender> sender_;
    int references_ = 0;
};

} // namespace

bool is_in_another_process(CORBA::Object_ptr object) {
    const omni_tracedmutex_lock lock(*omni::internalLock);
    return omniRemoteIdentity::downcast(object->_PR_getobj()->_identity()) != nullptr;
}

void send_calls(CORBA::Object_ptr object, std::shared_ptr<CallSender> sender) {
    omniObjRef* const reference = object->_PR_getobj();
    const omni_tracedmutex_lock lock(*omni::internalLock);
    omniIdentity* const identity = reference->_identity();
    if (omniRemoteIdentity::downcast(identity) != nullptr)
        reference->_setIdentity(new CallIdentity(*identity, std::move(sender)));
}

} // namespace RTC

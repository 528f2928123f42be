// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/direct_identity.hpp"

#include <omniORB4/callDescriptor.h>
#include <omniORB4/callHandle.h>
#include <omniORB4/omniObjRef.h>

namespace tandem::interceptor {

void DirectIdentity::give(omniCallDescriptor& call, omniLocalIdentity& object, GenericServant& servant) {
    omniObjRef* reference = call.objref();
    if (!reference) return;
    const omni_tracedmutex_lock lock(*omni::internalLock);
    omniIdentity* identity = reference->_identity();
    if (reference->_isForwardLocation() || object.deactivated() ||
        !omniInProcessIdentity::downcast(identity) || dynamic_cast<DirectIdentity*>(identity))
        return;
    reference->_setIdentity(new DirectIdentity(object, servant));
}

DirectIdentity::DirectIdentity(omniLocalIdentity& object, GenericServant& servant)
    : omniInProcessIdentity(object.key(), object.keysize()), object_(object), servant_(servant) {
    object_.gainRef();
}

DirectIdentity::~DirectIdentity() { object_.loseRef(); }

// When an object is deactivated or activated again, omniORB looks it up again, and the servant gives the reference
// another DirectIdentity.
void DirectIdentity::dispatch(omniCallDescriptor& call) {
    if (object_.deactivated()) [[unlikely]] {
        auto* usual = new omniInProcessIdentity(key(), keysize());
        call.objref()->_setIdentity(usual);
        return usual->dispatch(call);
    }
    if (!call.op()) [[unlikely]] // only asks whether the object is there
        return omniInProcessIdentity::dispatch(call);
    GenericServant& servant = servant_;
    omni::internalLock->unlock();
    // From here on, another thread that finds the object deactivated may delete this identity.
    if (servant.call_from_here(call)) [[likely]]
        return;
    omni::internalLock->lock();
    omniIdentity* identity = call.objref()->_identity();
    if (dynamic_cast<DirectIdentity*>(identity))
        identity = new omniInProcessIdentity(identity->key(), identity->keysize()); // for this call
    identity->dispatch(call);
}

} // namespace tandem::interceptor

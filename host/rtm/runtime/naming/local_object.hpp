// SPDX-License-Identifier: Apache-2.0
// Access to objects of this process without CORBA. OpenRTM-aist does the same where it calls
// POA::reference_to_servant(): a call through the pointer costs no marshalling and can return C++ values.
#pragma once
#include <cstddef>
#include <omniORB4/CORBA.h>
#include <rtm/Manager.h>

namespace RTC {

/// A counted reference to an object of this process, or no object. While it lives, the ORB does not delete the servant,
/// but the owner may deactivate it. The removal of a port waits up to a second for these references.
template <class T>
class LocalObject {
  public:
    LocalObject() = default;
    explicit LocalObject(const PortableServer::ServantBase_var& servant)
        : servant_(servant), object_(dynamic_cast<T*>(servant_.in())) {}
    T* get() const { return object_; }
    T* operator->() const { return object_; }
    explicit operator bool() const { return object_ != nullptr; }
    bool operator==(std::nullptr_t) const { return object_ == nullptr; }

  private:
    PortableServer::ServantBase_var servant_;
    T* object_ = nullptr;
};

/// Returns the object of a reference if it is in this process, in the root POA, and a T; otherwise none. [any-thread]
template <class T>
LocalObject<T> local_object(CORBA::Object_ptr reference) {
    if (CORBA::is_nil(reference)) return {};
    try {
        PortableServer::ServantBase_var servant =
            Manager::instance().thePOA()->reference_to_servant(reference);
        return LocalObject<T>(servant);
    } catch (const PortableServer::POA::ObjectNotActive&) {
        return {};
    } catch (const PortableServer::POA::WrongAdapter&) {
        return {};
    } catch (const CORBA::SystemException&) { // the ORB has been shut down
        return {};
    }
}

} // namespace RTC

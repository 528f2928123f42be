// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <omniORB4/CORBA.h>
#include <rtm/Manager.h>

namespace RTC {

/// An object of this process found by its reference, or nothing. Its owner ends it when it likes; ports wait
/// a second for those who hold them like this.
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

/// The object behind a reference when it lives in this process under the root POA.
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
    } catch (const CORBA::SystemException&) { // the ORB is going down
        return {};
    }
}

} // namespace RTC

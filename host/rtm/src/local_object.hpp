// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>
#include <rtm/Manager.h>

namespace RTC {

/// The object behind a reference when it lives in this process under the root POA, else NULL. Its owner keeps
/// it.
template <class T>
T* local_object(CORBA::Object_ptr reference) {
    if (CORBA::is_nil(reference)) return nullptr;
    try {
        PortableServer::ServantBase_var servant =
            Manager::instance().thePOA()->reference_to_servant(reference);
        return dynamic_cast<T*>(servant.in());
    } catch (const PortableServer::POA::ObjectNotActive&) {
        return nullptr;
    } catch (const PortableServer::POA::WrongAdapter&) {
        return nullptr;
    } catch (const CORBA::SystemException&) { // the ORB is going down
        return nullptr;
    }
}

} // namespace RTC

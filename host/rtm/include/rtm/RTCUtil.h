// SPDX-License-Identifier: Apache-2.0
// Tests which IDL interface of components an object has. All throw CORBA::SystemException if the object cannot be
// reached.
#ifndef RTC_UTILS_RTCUTIL_H
#define RTC_UTILS_RTCUTIL_H
#include <rtm/idl/OpenRTMSkel.h>
#include <rtm/idl/RTCSkel.h>

namespace RTC_Utils {

template <class Interface>
bool isA(CORBA::Object_ptr object) {
    typename Interface::_var_type narrowed = Interface::_narrow(object);
    return !CORBA::is_nil(narrowed.in());
}
inline bool isDataFlowComponent(CORBA::Object_ptr object) { return isA<OpenRTM::DataFlowComponent>(object); }
inline bool isFsmParticipant(CORBA::Object_ptr object) { return isA<RTC::FsmParticipant>(object); }
inline bool isFsmObject(CORBA::Object_ptr object) { return isA<RTC::FsmObject>(object); }
inline bool isMultiModeObject(CORBA::Object_ptr object) { return isA<RTC::MultiModeObject>(object); }

} // namespace RTC_Utils
#endif

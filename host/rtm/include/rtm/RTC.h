// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_H
#define RTC_H
#include <rtm/config_rtc.h>
#include <rtm/version.h>

#include <omniORB4/CORBA.h>
#include <omnithread.h>
#include <rtm/idl/OpenRTMSkel.h>

#include <coil/Properties.h>

#define DLL_EXPORT
#define WINAPI

namespace RTC {
using Properties = coil::Properties;
} // namespace RTC
#endif

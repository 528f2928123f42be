// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_H
#define RTC_H
#include <rtm/config_rtc.h>
#include <rtm/version.h>

// Component sources rely on these includes.
#include <algorithm>
#include <chrono>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <omniORB4/CORBA.h>
#include <omnithread.h>
#include <rtm/idl/OpenRTMSkel.h>

#include <coil/Guard.h>
#include <coil/Mutex.h>
#include <coil/Properties.h>
#include <coil/Task.h>
#include <coil/Time.h>
#include <coil/stringutil.h>

#define DLL_EXPORT
#define WINAPI

namespace RTC {
using Properties = coil::Properties;
/// Handle of an execution context.
using UniqueId = ExecutionContextHandle_t;
} // namespace RTC
#endif

// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SIMULATOREXECUTIONCONTEXT_H
#define RTC_SIMULATOREXECUTIONCONTEXT_H
#include <rtm/OpenHRPExecutionContext.h>

namespace RTC {

/// Another name of OpenRTM-aist for OpenHRPExecutionContext.
class SimulatorExecutionContext : public OpenHRPExecutionContext {};

class Manager;

} // namespace RTC
extern "C" {
/// The module function of OpenRTM-aist that registers the type. The manager has already registered it.
void SimulatorExecutionContextInit(RTC::Manager* manager);
}
#endif

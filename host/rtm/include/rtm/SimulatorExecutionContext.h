// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SIMULATOREXECUTIONCONTEXT_H
#define RTC_SIMULATOREXECUTIONCONTEXT_H
#include <rtm/OpenHRPExecutionContext.h>

namespace RTC {

/// The same as OpenHRPExecutionContext, under another name of OpenRTM-aist.
class SimulatorExecutionContext : public OpenHRPExecutionContext {};

class Manager;

} // namespace RTC
extern "C" {
/// The module function of OpenRTM-aist, which registers the type. The manager has registered it before.
void SimulatorExecutionContextInit(RTC::Manager* manager);
}
#endif

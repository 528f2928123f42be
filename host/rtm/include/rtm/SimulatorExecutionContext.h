// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SIMULATOREXECUTIONCONTEXT_H
#define RTC_SIMULATOREXECUTIONCONTEXT_H
#include <rtm/OpenHRPExecutionContext.h>

namespace RTC {

/// OpenHRPExecutionContext under the name that simulators ask for.
class SimulatorExecutionContext : public OpenHRPExecutionContext {};

class Manager;

} // namespace RTC
extern "C" {
/// Makes the type known to the manager, which knows it anyway.
void SimulatorExecutionContextInit(RTC::Manager* manager);
}
#endif

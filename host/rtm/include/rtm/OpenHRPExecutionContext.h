// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OPENHRPEXECUTIONCONTEXT_H
#define RTC_OPENHRPEXECUTIONCONTEXT_H
#include <rtm/ExecutionContextBase.h>

namespace RTC {

/// A context without a thread: tick() runs one cycle in the calling thread, and requested transitions are
/// carried out in the thread that requests them. Simulators drive it.
class OpenHRPExecutionContext : public ExecutionContextServant<POA_OpenRTM::ExtTrigExecutionContextService> {
  public:
    OpenHRPExecutionContext();
    void tick() override;
};

} // namespace RTC

namespace RTC {
class Manager;
}
extern "C" {
/// The module function of OpenRTM-aist, which registers the type. The manager has registered it before.
void OpenHRPExecutionContextInit(RTC::Manager* manager);
}
#endif

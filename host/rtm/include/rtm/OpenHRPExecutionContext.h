// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OPENHRPEXECUTIONCONTEXT_H
#define RTC_OPENHRPEXECUTIONCONTEXT_H
#include <rtm/ExecutionContextBase.h>

namespace RTC {

/// A context without a thread: tick() runs one cycle in the caller's thread, and requested transitions are
/// carried out by the thread that asks for them.
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
/// Makes the type known to the manager, which knows it anyway.
void OpenHRPExecutionContextInit(RTC::Manager* manager);
}
#endif

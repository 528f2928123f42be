// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OPENHRPEXECUTIONCONTEXT_H
#define RTC_OPENHRPEXECUTIONCONTEXT_H
#include <rtm/ExecutionContextBase.h>

namespace RTC {

/// A context without a thread, for simulators: tick() runs one cycle in the calling thread, and the requesting thread
/// carries out transitions.
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
/// The module function of OpenRTM-aist that registers the type. The manager has already registered it.
void OpenHRPExecutionContextInit(RTC::Manager* manager);
}
#endif

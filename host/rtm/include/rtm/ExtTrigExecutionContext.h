// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_EXTTRIGEXECUTIONCONTEXT_H
#define RTC_EXTTRIGEXECUTIONCONTEXT_H
#include <memory>
#include <rtm/ExecutionContextBase.h>

namespace RTC {

/// A context whose thread runs one cycle for each tick(). tick() does not wait for the cycle, and no tick is lost.
/// The requesting thread carries out transitions, between cycles.
class ExtTrigExecutionContext : public ExecutionContextServant<POA_OpenRTM::ExtTrigExecutionContextService> {
  public:
    ExtTrigExecutionContext();
    ~ExtTrigExecutionContext() override;
    void tick() override;

  protected:
    ReturnCode_t onStarted() override;
    ReturnCode_t onStopping() override;

  private:
    struct Worker;
    void run(Worker& worker);

    mutable std::mutex m_workerMutex;
    std::shared_ptr<Worker> m_worker;
};

} // namespace RTC

namespace RTC {
class Manager;
}
extern "C" {
/// The module function of OpenRTM-aist that registers the type. The manager has already registered it.
void ExtTrigExecutionContextInit(RTC::Manager* manager);
}
#endif

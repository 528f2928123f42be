// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PERIODICEXECUTIONCONTEXT_H
#define RTC_PERIODICEXECUTIONCONTEXT_H
#include <memory>
#include <rtm/ExecutionContextBase.h>

namespace RTC {
class Manager;
}

namespace RTC_exp {

/// A context with its own thread. Cycles run in absolute time, on the grid that both hosts share
/// (tandem::rt::PeriodicTick), plus the phase. Periods lost to an overrun are skipped. The thread sleeps while no
/// component is active. The first cycle, which carries out the activation, runs at once.
class PeriodicExecutionContext : public RTC::ExecutionContextServant<POA_RTC::ExecutionContextService> {
  public:
    PeriodicExecutionContext();
    ~PeriodicExecutionContext() override;

    /// Ours: counted since the start of the context; kept after its stop.
    struct TickStatistics {
        std::uint64_t cycles = 0;
        std::uint64_t overruns = 0; ///< cycles whose time had passed when the previous one finished
        std::uint64_t skipped = 0;  ///< periods without a cycle because of overruns
        std::chrono::nanoseconds max_lateness{0}; ///< largest delay of a cycle's start
    };
    TickStatistics tickStatistics() const;

  protected:
    RTC::ReturnCode_t onStarted() override;
    RTC::ReturnCode_t onStopping() override;
    RTC::ReturnCode_t onSetRate(double rate) override;
    bool hasThread() const override;
    void onTransitionRequested() override;
    void addStatistics(coil::Properties& properties) override;

  private:
    struct Worker;
    std::shared_ptr<Worker> worker() const;
    void run(Worker& worker);
    void createTick(Worker& worker);

    mutable std::mutex m_workerMutex;
    std::shared_ptr<Worker> m_worker;
    TickStatistics m_finishedStatistics;
};

} // namespace RTC_exp

namespace RTC {
class Manager;
}
extern "C" {
/// The module function of OpenRTM-aist that registers the type. The manager has already registered it.
void PeriodicExecutionContextInit(RTC::Manager* manager);
}
#endif

// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_PERIODICTASK_H
#define COIL_PERIODICTASK_H
#include <coil/PeriodicTaskBase.h>
#include <condition_variable>
#include <mutex>

namespace coil {

/// Calls its function in a separate thread, at multiples of the period after activate(). Skips missed calls. Period
/// 0: without a pause. All functions: [any-thread].
class PeriodicTask : public PeriodicTaskBase {
  public:
    PeriodicTask() = default;
    ~PeriodicTask() override;
    using PeriodicTaskBase::setPeriod;
    using PeriodicTaskBase::setTask;
    void activate() override;
    /// Requests the end of the thread. wait() waits for it.
    void finalize() override;
    int suspend() override;
    int resume() override;
    void signal() override;
    void setTask(std::function<void()> func) override;
    void setPeriod(std::chrono::nanoseconds period) override;
    void executionMeasure(bool value) override;
    void executionMeasureCount(unsigned int n) override;
    void periodicMeasure(bool value) override;
    void periodicMeasureCount(unsigned int n) override;
    TimeMeasure::Statistics getExecStat() override;
    TimeMeasure::Statistics getPeriodStat() override;

  protected:
    int svc() override;

  private:
    /// Statistics of one kind of duration, renewed after every `every` durations.
    struct Measure {
        bool on = false;
        unsigned int every = 1000;
        TimeMeasure time;
        TimeMeasure::Statistics last;
        void tick();
        void tack();
    };

    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::function<void()> m_func;
    std::chrono::nanoseconds m_period{0};
    bool m_alive = false;
    bool m_suspended = false;
    unsigned int m_signals = 0;
    Measure m_exec;
    Measure m_cycle;
};

} // namespace coil
#endif

// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/cycle_trigger.hpp"

#include <LifecycleListener.h>
#include <fmt/format.h>

namespace tandem::engine {
namespace {

using namespace std::chrono_literals;

double to_ms(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }

/// Triggers at each tick of the period's grid (periodic_tick.hpp).
class PeriodicTrigger : public CycleTrigger {
  public:
    PeriodicTrigger(const ComponentHost& component, std::optional<std::chrono::nanoseconds> tick_spin,
                    std::function<void()> rehearse)
        : period_(component.profile().period), tick_({period_, component.profile().phase, true, tick_spin,
                                                      std::move(rehearse), component.name()}) {}
    bool wait() override {
        tick_.wait();
        return !tick_.interrupted();
    }
    void interrupt() override { tick_.interrupt(); }
    rt::PeriodicTick* tick() override { return &tick_; }
    crash::CallbackText* callback_text() const override { return tick_.callback_text(); }
    std::string stats() const override {
        const rt::TickStats stats = tick_.stats();
        return fmt::format("every {} ms, {} ticks, {} overruns, {} periods skipped, at most {:.1f} us late",
                           to_ms(period_), stats.ticks, stats.overruns, stats.skipped,
                           static_cast<double>(stats.lateness_ns_max) / 1e3);
    }

  private:
    const std::chrono::nanoseconds period_;
    rt::PeriodicTick tick_;
};

/// The common part of the triggers without a period: counts cycles.
class CountingTrigger : public CycleTrigger {
  public:
    bool wait() override {
        if (interrupted_ || !wait_for_next()) return false;
        cycles_.fetch_add(1, std::memory_order_relaxed);
        return true;
    }
    void interrupt() override { interrupted_ = true; }
    std::string stats() const override {
        return fmt::format("{} cycles", cycles_.load(std::memory_order_relaxed));
    }

  protected:
    /// Returns false if interrupted.
    virtual bool wait_for_next() = 0;
    std::atomic<bool> interrupted_{false};

  private:
    std::atomic<std::uint64_t> cycles_{0};
};

/// Triggers once after the start, then whenever an input has arrived. A component that takes one value per cycle gets
/// further cycles as long as values are left. A component that takes none is not executed again before the next
/// arrival, so that an unread port does not become a busy loop.
class InputTrigger : public CountingTrigger {
  public:
    explicit InputTrigger(ComponentHost& component) : component_(component) {}
    void interrupt() override {
        CountingTrigger::interrupt();
        component_.input_signal().arrived();
    }
    std::string stats() const override { return "on arrival, " + CountingTrigger::stats(); }

  protected:
    bool wait_for_next() override {
        const std::size_t waiting = component_.waiting_value_count();
        // Inputs that arrived before the first cycle belong to that cycle.
        if (is_first_cycle_) component_.input_signal().wait_for(0ns);
        bool due = is_first_cycle_ || (waiting != 0 && waiting < waiting_at_last_cycle_);
        while (!due && !interrupted_) {
            // A source outside the component (DataPortSource) that does not notify has to be polled.
            if (component_.has_polled_sources()) {
                due = component_.input_signal().wait_for(1ms) || component_.waiting_value_count() > waiting;
            } else {
                component_.input_signal().wait();
                due = true;
            }
        }
        is_first_cycle_ = false;
        waiting_at_last_cycle_ = component_.waiting_value_count();
        return !interrupted_;
    }

  private:
    ComponentHost& component_;
    bool is_first_cycle_ = true;
    std::size_t waiting_at_last_cycle_ = 0; // at the start of that cycle
};

/// Triggers one cycle after the other. While the component is not active, triggers once after each change of state.
class LoopTrigger : public CountingTrigger, LifecycleListener {
  public:
    explicit LoopTrigger(ComponentHost& component) : component_(component) {
        component_.component().addLifecycleListener(this);
    }
    ~LoopTrigger() override { component_.component().removeLifecycleListener(this); }
    void interrupt() override {
        CountingTrigger::interrupt();
        component_.input_signal().arrived();
    }
    std::string stats() const override { return "without a pause, " + CountingTrigger::stats(); }

  protected:
    bool wait_for_next() override {
        if (!component_.is_active()) component_.input_signal().wait();
        return !interrupted_;
    }

  private:
    void stateChanged(LifecycleState) override { component_.input_signal().arrived(); }

    ComponentHost& component_;
};

} // namespace

std::unique_ptr<CycleTrigger> make_cycle_trigger(ComponentHost& component,
                                                 std::optional<std::chrono::nanoseconds> tick_spin,
                                                 std::function<void()> rehearse) {
    switch (component.profile().execution_type) {
    case ExecutionType::aperiodic:
        return std::make_unique<InputTrigger>(component);
    case ExecutionType::aperiodic_loop:
        return std::make_unique<LoopTrigger>(component);
    default:
        return std::make_unique<PeriodicTrigger>(component, tick_spin, std::move(rehearse));
    }
}

} // namespace tandem::engine

// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/cycle_trigger.hpp"

#include <spdlog/fmt/fmt.h>
#include <thread>

namespace tandem::engine {
namespace {

using namespace std::chrono_literals;

double ms(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }

class PeriodicTrigger : public CycleTrigger {
  public:
    PeriodicTrigger(const ComponentProfile& profile, std::chrono::nanoseconds spin,
                    std::function<void()> warm_up)
        : period_(profile.period), tick_({profile.period, profile.phase, true, spin, std::move(warm_up)}) {}
    bool wait() override {
        tick_.wait();
        return !tick_.interrupted();
    }
    void interrupt() override { tick_.interrupt(); }
    std::string stats() const override {
        const rt::TickStats stats = tick_.stats();
        return fmt::format("every {} ms, {} ticks, {} overruns, {} periods skipped, at most {:.1f} us late",
                           ms(period_), stats.ticks, stats.overruns, stats.skipped,
                           static_cast<double>(stats.lateness_ns_max) / 1e3);
    }

  private:
    const std::chrono::nanoseconds period_;
    rt::PeriodicTick tick_;
};

class CountingTrigger : public CycleTrigger {
  public:
    bool wait() override {
        if (stopping_ || !wait_for_next()) return false;
        cycles_.fetch_add(1, std::memory_order_relaxed);
        return true;
    }
    void interrupt() override { stopping_ = true; }
    std::string stats() const override {
        return fmt::format("{} cycles", cycles_.load(std::memory_order_relaxed));
    }

  protected:
    virtual bool wait_for_next() = 0;
    std::atomic<bool> stopping_{false};

  private:
    std::atomic<std::uint64_t> cycles_{0};
};

/// Once at the beginning, then whenever an input has arrived. A component that takes one value per cycle gets
/// a cycle for each that waits; one that takes none is not asked again before the next arrival.
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
        const std::size_t left = component_.queued_value_count();
        bool turn = is_first_cycle_ || (left != 0 && left < queued_at_last_cycle_);
        while (!turn && !stopping_) {
            // A source tells nobody that it has something: it is asked.
            const bool has_sources = component_.has_sources();
            turn = component_.input_signal().wait_for(has_sources ? 1ms : 1s) ||
                   (has_sources && component_.queued_value_count() > left);
        }
        is_first_cycle_ = false;
        queued_at_last_cycle_ = component_.queued_value_count();
        return !stopping_;
    }

  private:
    ComponentHost& component_;
    bool is_first_cycle_ = true;
    std::size_t queued_at_last_cycle_ = 0;
};

class LoopTrigger : public CountingTrigger {
  public:
    explicit LoopTrigger(ComponentHost& component) : component_(component) {}
    std::string stats() const override { return "without a pause, " + CountingTrigger::stats(); }

  protected:
    bool wait_for_next() override {
        if (!component_.is_active()) std::this_thread::sleep_for(1ms);
        return true;
    }

  private:
    ComponentHost& component_;
};

} // namespace

std::unique_ptr<CycleTrigger> make_cycle_trigger(ComponentHost& component, std::chrono::nanoseconds spin,
                                                 std::function<void()> warm_up) {
    switch (component.profile().execution_type) {
    case ExecutionType::aperiodic:
        return std::make_unique<InputTrigger>(component);
    case ExecutionType::aperiodic_loop:
        return std::make_unique<LoopTrigger>(component);
    default:
        return std::make_unique<PeriodicTrigger>(component.profile(), spin, std::move(warm_up));
    }
}

} // namespace tandem::engine

// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/pace.hpp"

#include <spdlog/fmt/fmt.h>
#include <thread>

namespace tandem::engine {
namespace {

using namespace std::chrono_literals;

double ms(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }

class PeriodicPace : public Pace {
  public:
    PeriodicPace(const ComponentProfile& profile, std::chrono::nanoseconds spin,
                 std::function<void()> rehearsal)
        : period_(profile.period), tick_({profile.period, profile.phase, true, spin, std::move(rehearsal)}) {}
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

class CountedPace : public Pace {
  public:
    bool wait() override {
        if (stopping_ || !wait_for_turn()) return false;
        cycles_.fetch_add(1, std::memory_order_relaxed);
        return true;
    }
    void interrupt() override { stopping_ = true; }
    std::string stats() const override {
        return fmt::format("{} cycles", cycles_.load(std::memory_order_relaxed));
    }

  protected:
    virtual bool wait_for_turn() = 0;
    std::atomic<bool> stopping_{false};

  private:
    std::atomic<std::uint64_t> cycles_{0};
};

/// Once at the beginning, then whenever an input has arrived. A component that takes one value per cycle gets
/// a cycle for each that waits; one that takes none is not asked again before the next arrival.
class ArrivalPace : public CountedPace {
  public:
    explicit ArrivalPace(ComponentHost& component) : component_(component) {}
    void interrupt() override {
        CountedPace::interrupt();
        component_.arrival().arrived();
    }
    std::string stats() const override { return "on arrival, " + CountedPace::stats(); }

  protected:
    bool wait_for_turn() override {
        const std::size_t left = component_.values_waiting();
        bool turn = first_ || (left != 0 && left < at_last_turn_);
        while (!turn && !stopping_) {
            // A source tells nobody that it has something: it is asked.
            const bool has_sources = component_.has_sources();
            turn = component_.arrival().wait(has_sources ? 1ms : 1s) ||
                   (has_sources && component_.values_waiting() > left);
        }
        first_ = false;
        at_last_turn_ = component_.values_waiting();
        return !stopping_;
    }

  private:
    ComponentHost& component_;
    bool first_ = true;
    std::size_t at_last_turn_ = 0;
};

class LoopPace : public CountedPace {
  public:
    explicit LoopPace(ComponentHost& component) : component_(component) {}
    std::string stats() const override { return "without a pause, " + CountedPace::stats(); }

  protected:
    bool wait_for_turn() override {
        if (!component_.active()) std::this_thread::sleep_for(1ms);
        return true;
    }

  private:
    ComponentHost& component_;
};

} // namespace

std::unique_ptr<Pace> make_pace(ComponentHost& component, std::chrono::nanoseconds spin,
                                std::function<void()> rehearsal) {
    switch (component.profile().execution) {
    case Execution::aperiodic:
        return std::make_unique<ArrivalPace>(component);
    case Execution::aperiodic_loop:
        return std::make_unique<LoopPace>(component);
    default:
        return std::make_unique<PeriodicPace>(component.profile(), spin, std::move(rehearsal));
    }
}

} // namespace tandem::engine

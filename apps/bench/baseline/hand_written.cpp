// SPDX-License-Identifier: Apache-2.0
// The minimum that a programmer would write by hand for what tandem/opros and tandem/rtm measure within one
// process: a queue behind a mutex, a virtual call, a thread behind a condition variable, a loop on an absolute
// sleep.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/in_process_cases.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/tick_budget.hpp"
#include "apps/bench/machine/cores.hpp"
#include "apps/bench/measurements/time_each_call.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace tandem::bench {

namespace {

/// Keeps the newest 15 values, as an OPRoS input port does by default.
template <class T>
class Queue {
  public:
    explicit Queue(const T& prototype) : slots_(15, prototype) {}
    void push(const T& value) {
        const std::lock_guard<std::mutex> lock(mutex_);
        slots_[next_] = value;
        next_ = (next_ + 1) % slots_.size();
    }

  private:
    std::mutex mutex_;
    std::vector<T> slots_;
    std::size_t next_ = 0;
};

/// The counterpart of push() of an OPRoS port.
void push_double_by_hand(Session& session) {
    Queue<double> queue(0);
    time_each_call(session, [&](double value) { queue.push(value); });
}

/// Like the function above, with an array that is copied into a slot. The slot keeps its memory.
void push_array(Session& session) {
    const std::vector<double> values(session.bytes() / sizeof(double), 1.5);
    Queue<std::vector<double>> queue(values);
    time_each_call(session, [&](double) { queue.push(values); });
}

/// The called service.
class Doubler {
  public:
    virtual ~Doubler() = default;
    virtual double twice(double value) { return 2 * value; }
};

/// A virtual call is all that a service call within one process needs.
void call_by_hand(Session& session) {
    Doubler doubler;
    Doubler* service = &doubler;
    asm volatile("" : "+r"(service)); // otherwise the compiler would know the class and call it directly
    double sum = 0;
    time_each_call(session, [&](double value) { sum += service->twice(value); });
    asm volatile(""
                 :
                 : "r"(&sum)
                 : "memory"); // otherwise the compiler would drop the calls, because their results are unused
}

/// A thread that sleeps until a value is sent, and publishes it.
class Listener {
  public:
    Listener() : thread_([this] { run(); }) {}
    ~Listener() {
        send(stop_value);
        thread_.join();
    }
    /// Values are positive.
    void send(double value) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            sent_ = value;
        }
        wake_.notify_one();
    }
    double last_received() const { return received_; }

  private:
    static constexpr double stop_value = -1;

    void run() {
        std::unique_lock<std::mutex> lock(mutex_);
        for (;;) {
            wake_.wait(lock, [this] { return sent_ != received_.load(); });
            if (sent_ == stop_value) return;
            received_ = sent_;
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    double sent_ = 0; // guarded by mutex_
    std::atomic<double> received_{0};
    std::thread thread_; // last, because it uses the other members
};

/// Measures from the notification to the answer of the woken thread. Each of the two threads needs a core.
void event_by_hand(Session& session) {
    pin_to_all_cores();
    Listener listener;
    double sent = 0;
    const auto send_and_wait = [&](double) {
        listener.send(++sent);
        while (listener.last_received() != sent) {
        }
    };
    time_each_call(session, send_and_wait, [](double) { busy_wait(2e5); });
}

std::int64_t monotonic_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// Measures the lateness of a loop on clock_nanosleep(). Missed periods are skipped, as a periodic executor
/// skips them.
void measure_nanosleep_lateness(Session& session) {
    constexpr std::int64_t second_ns = 1'000'000'000;
    TickCounts counts;
    std::int64_t next = monotonic_ns();
    for (int i = 0; i < lateness_ticks(session.budget()); ++i) {
        next += tick_period_ns;
        const timespec until{next / second_ns, next % second_ns};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
        const std::int64_t late = monotonic_ns() - next;
        session.add_result(static_cast<double>(late));
        counts.add(late, tick_period_ns);
        next += late / tick_period_ns * tick_period_ns;
    }
    session.set_tick_counts(counts);
}

} // namespace

void add_hand_written_cases(Registry& registry) {
    InProcessCases cases(registry, Group::baseline, "hand-written");
    cases.add("push", sizeof(double), Wake::none, push_double_by_hand);
    cases.add("push", 1000 * sizeof(double), Wake::none, push_array);
    cases.add("local-call", sizeof(double), Wake::none, call_by_hand);
    cases.add_event(event_by_hand);
    cases.add("tick", sizeof(double), Wake::blocking, measure_nanosleep_lateness);
}

} // namespace tandem::bench

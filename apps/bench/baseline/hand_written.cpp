// SPDX-License-Identifier: Apache-2.0
// The least that anybody would write by hand for what opros_components.cpp measures: a queue behind a mutex, a
// virtual call, a thread behind a condition variable, a loop on an absolute sleep.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/power_profile.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/time_each.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace tandem::bench {

namespace {

/// The newest 15 values.
template <class T>
class Queue {
  public:
    explicit Queue(const T& like) : slots_(15, like) {}
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

void push_double(Session& session) {
    Queue<double> queue(0);
    time_each_call(session, [&](double value) { queue.push(value); });
}

void push_array(Session& session) {
    const std::vector<double> values(session.bytes() / sizeof(double), 1.5);
    Queue<std::vector<double>> queue(values);
    time_each_call(session, [&](double) { queue.push(values); });
}

class Doubler {
  public:
    virtual ~Doubler() = default;
    virtual double twice(double value) { return 2 * value; }
};

void call(Session& session) {
    Doubler doubler;
    Doubler* called = &doubler;
    asm volatile("" : "+r"(called)); // or the compiler would know whom it calls
    double sum = 0;
    time_each_call(session, [&](double value) { sum += called->twice(value); });
    asm volatile("" : : "r"(&sum) : "memory");
}

/// A thread that sleeps until there is a value, and passes it on.
class Listener {
  public:
    Listener()
        : thread_([this] {
              std::unique_lock<std::mutex> lock(mutex_);
              for (;;) {
                  wake_.wait(lock, [this] { return sent_ != heard_.load(); });
                  if (sent_ < 0) return;
                  heard_ = sent_;
              }
          }) {}
    ~Listener() {
        send(-1);
        thread_.join();
    }
    void send(double value) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            sent_ = value;
        }
        wake_.notify_one();
    }
    double heard() const { return heard_; }

  private:
    std::mutex mutex_;
    std::condition_variable wake_;
    double sent_ = 0;
    std::atomic<double> heard_{0};
    std::thread thread_;
};

void event(Session& session) {
    pin_to_all_cores();
    Listener listener;
    const std::uint64_t pause = to_ticks(2e5);
    double value = 0;
    const auto loop = [&] {
        while (session.needs_more()) {
            for (const std::uint64_t begin = ticks(); ticks() - begin < pause;) {
            }
            const std::uint64_t before = ticks();
            listener.send(++value);
            while (listener.heard() != value) {
            }
            const std::uint64_t now = ticks();
            session.add_sample(now - before, now);
        }
    };
    session.begin_warm_up();
    loop();
    session.begin_measuring();
    loop();
    session.end_measuring();
}

void tick(Session& session) {
    constexpr std::int64_t second_ns = 1'000'000'000, period_ns = 1'000'000;
    const int count = session.budget().samples >= 50'000 ? 10'000 : 1'000;
    const auto now_ns = [] {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        return now.tv_sec * second_ns + now.tv_nsec;
    };
    TickCounts counts;
    std::int64_t next = now_ns();
    for (int i = 0; i < count; ++i) {
        next += period_ns;
        const timespec until{next / second_ns, next % second_ns};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
        const std::int64_t late = now_ns() - next;
        session.add_result(static_cast<double>(late));
        counts.add(late, period_ns);
        next += late / period_ns * period_ns;
    }
    session.set_tick_counts(counts);
}

} // namespace

void add_hand_written_cases(Registry& registry) {
    Case entry;
    entry.group = Group::baseline;
    entry.subject = "hand-written";
    entry.placement = Placement::alone;
    entry.wake = Wake::none;
    const auto add = [&](const char* operation, std::size_t bytes, void (*run)(Session&)) {
        entry.operation = operation;
        entry.bytes = bytes;
        entry.run = run;
        registry.cases.push_back(entry);
    };
    add("push", sizeof(double), push_double);
    add("push", 1000 * sizeof(double), push_array);
    add("local-call", sizeof(double), call);
    entry.wake = Wake::blocking;
    add("event", sizeof(double), event);
    entry.regime = Regime::low_latency_idle;
    add("event", sizeof(double), event);
    entry.regime = Regime::normal;
    add("tick", sizeof(double), tick);
}

} // namespace tandem::bench

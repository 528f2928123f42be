// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/futex.hpp"

#include <array>
#include <pthread.h>

namespace tandem::shm {

/// Ends long sleeps at their bound without a kernel timer in each of them: setting and cancelling one costs a
/// sleep 0.1 us and more, of 2. A thread of this process, started by the first such sleep, keeps the one
/// timer for all: it sleeps until the earliest deadline, and ends the sleep of whoever has slept past his in
/// two ways. It wakes his word, which works whatever signals his thread blocks; and it sends him a SIGURG
/// that does nothing, which works when the file behind his word is truncated and nobody can wake him by it
/// any more. Only both together leave a sleeper without a bound: such a file, and a thread that blocks our
/// signal or a program that takes our handler away, later than the thread's first sleep here.
class SleepAlarm {
  public:
    static constexpr std::uint64_t shortest_ns = 10'000'000; ///< below it a timer is cheaper than the thread

    static SleepAlarm& of_process();

    /// [any-thread] Sleeps while `word` holds `expected`, at most until now_ns() reaches `deadline` or a
    /// little later; may return early. False, without having slept: no slot, no thread or no signal is to be
    /// had, the caller sets a timer of his own.
    bool sleep(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);

    SleepAlarm(const SleepAlarm&) = delete;
    SleepAlarm& operator=(const SleepAlarm&) = delete;

  private:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    static constexpr std::uint64_t again_ns = 1'000'000;

    /// A sleeper. The thread is set first and cleared last; with a deadline of `never` nobody looks at the
    /// rest.
    struct alignas(64) Slot {
        std::atomic<pid_t> thread{0};
        std::atomic<std::atomic<std::uint32_t>*> word{nullptr};
        std::atomic<std::uint64_t> deadline{never};
    };
    enum class State { unborn, runs, refused };

    SleepAlarm();
    ~SleepAlarm();
    bool start();
    void run();
    std::uint64_t end_late_sleeps(std::uint64_t now);
    void nudge();
    void forget_thread(); // in a fork()ed child, which has none

    std::array<Slot, 64> slots_;
    std::atomic<std::uint64_t> next_{never}; // when the thread looks again, if nobody nudges it
    std::atomic<std::uint32_t> nudges_{0};
    std::atomic<State> state_{State::unborn};
    std::atomic<bool> stop_{false};
    pthread_mutex_t starting_ = PTHREAD_MUTEX_INITIALIZER;
    pthread_t thread_{};
    pid_t process_ = 0;
    bool signal_handled_ = false; // stays so in a fork()ed child
};

} // namespace tandem::shm

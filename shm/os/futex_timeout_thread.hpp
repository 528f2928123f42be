// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <pthread.h>
#include <span>

namespace tandem::shm {

/// Ends long futex sleeps at their deadline without a kernel timer in each of them: setting and cancelling
/// one costs a sleep 0.1 us and more, of 2. One thread of this process, started by the first such sleep,
/// keeps the one timer for all: it sleeps until the earliest deadline and then ends the sleep that is over in
/// two ways. It wakes the word, which works whatever signals the sleeper blocks; and it sends the sleeper a
/// SIGURG whose handler does nothing, which works when the file behind the word was truncated and the word
/// cannot be woken any more. A sleep has no bound only if both fail: the file is truncated, and the thread
/// blocks SIGURG, or the program replaces its handler, after the thread's first sleep here.
class FutexTimeoutThread {
  public:
    static constexpr std::uint64_t min_timeout_ns = 10'000'000; ///< below it a kernel timer is cheaper

    static FutexTimeoutThread& of_process();

    /// [any-thread] Sleeps while `word` holds `expected`, at most until now_ns() reaches `deadline` or a
    /// little later; may return early. False, without having slept: no slot, no thread or no signal is
    /// available, and the caller has to set a timer.
    bool sleep(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);

    /// [any-thread] Ends all sleeps of this process on words in that memory, as if their deadlines had come. To be called
    /// after the words have changed, so that no other sleep begins.
    void end_sleeps(std::span<const std::byte> memory);

    FutexTimeoutThread(const FutexTimeoutThread&) = delete;
    FutexTimeoutThread& operator=(const FutexTimeoutThread&) = delete;

  private:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    static constexpr std::uint64_t retry_ns = 1'000'000;

    /// A sleeper. `thread` is set first and cleared last; the other fields count only while `deadline` is not
    /// `never`.
    struct alignas(64) Slot {
        std::atomic<pid_t> thread{0};
        std::atomic<std::atomic<std::uint32_t>*> word{nullptr};
        std::atomic<std::uint64_t> deadline{never};
    };
    enum class State { not_started, running, unavailable };

    FutexTimeoutThread();
    ~FutexTimeoutThread();
    bool start();
    void run();
    std::uint64_t end_overdue_sleeps(std::uint64_t now);
    void wake_thread();
    void reset_after_fork(); // in the child, which has no such thread

    std::array<Slot, 256> slots_;
    std::atomic<std::uint64_t> next_check_{never}; // when the thread wakes up by itself
    std::atomic<std::uint32_t> wake_count_{0};     // futex word of the thread
    std::atomic<State> state_{State::not_started};
    std::atomic<bool> stop_{false};
    pthread_mutex_t starting_ = PTHREAD_MUTEX_INITIALIZER;
    pthread_t thread_{};
    pid_t process_ = 0;
    bool signal_handled_ = false; // stays true in a fork()ed child
};

} // namespace tandem::shm

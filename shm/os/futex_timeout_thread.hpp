// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <pthread.h>
#include <span>

namespace tandem::shm {

/// Ends long futex sleeps at their deadlines without a kernel timer in each of them: setting and cancelling a timer adds 0.1 us
/// or more to a sleep's 2 us. The first such sleep starts one thread in this process, which keeps the only timer: it sleeps
/// until the earliest deadline and then ends the overdue sleep in two ways.
///   - It wakes the word. This works whatever signals the sleeper blocks.
///   - It sends the sleeper a SIGURG, whose handler does nothing. This works when the file behind the word was truncated and
///     the word can no longer be woken.
/// A sleep is unbounded only if both fail: the file is truncated, and either the sleeper blocked SIGURG or the program replaced
/// its handler after the sleeper's first sleep here.
class FutexTimeoutThread {
  public:
    static constexpr std::uint64_t min_timeout_ns =
        10'000'000; ///< for shorter sleeps a kernel timer is cheaper

    static FutexTimeoutThread& of_process();

    /// [any-thread] Sleeps while `word` holds `expected`, until shortly after now_ns() reaches `deadline`; may return early.
    /// Returns false, without having slept, if no slot, thread or signal is available: the caller must set a timer.
    bool sleep(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);

    /// [any-thread] Ends all sleeps of this process on words in `memory`, as if their deadlines had passed. Change the words
    /// before this call, so that no new sleep begins.
    void end_sleeps(std::span<const std::byte> memory);

    FutexTimeoutThread(const FutexTimeoutThread&) = delete;
    FutexTimeoutThread& operator=(const FutexTimeoutThread&) = delete;

  private:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    static constexpr std::uint64_t retry_ns = 1'000'000;

    /// One sleeper. `thread` is set first and cleared last. The other fields are valid only while `deadline` is not `never`.
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
    void reset_after_fork(); // runs in the child, which has no timeout thread

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

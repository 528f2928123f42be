// SPDX-License-Identifier: Apache-2.0
#include "shm/os/bounded_sleep.hpp"

#include "shm/os/futex.hpp"
#include "shm/os/futex_timeout_thread.hpp"

namespace tandem::shm {

namespace {

/// CLOCK_MONOTONIC with a resolution of a few milliseconds, at a sixth of the cost.
std::uint64_t coarse_now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

/// FutexTimeoutThread::end_sleeps() may have to end a longer sleep. Without a slot there, it is divided into sleeps of this
/// length.
constexpr std::uint64_t max_kernel_timeout_ns = 1'000'000'000;

bool sleep_until_deadline(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline,
                          std::uint64_t timeout_ns) {
    if (timeout_ns >= FutexTimeoutThread::min_timeout_ns &&
        FutexTimeoutThread::of_process().sleep(word, expected, deadline))
        return true;
    return futex_wait_timed(word, expected, std::min(timeout_ns, max_kernel_timeout_ns)) ||
           timeout_ns > max_kernel_timeout_ns;
}

} // namespace

void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline) {
    const std::uint64_t now = now_ns();
    if (now < deadline) sleep_until_deadline(word, expected, deadline, deadline - now);
}

BoundedSleep::BoundedSleep(std::chrono::nanoseconds bound)
    : bound_ns_(bounded_ns(bound)), started_ns_(coarse_now_ns()) {}

bool BoundedSleep::sleep_while(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
    std::uint64_t left = bound_ns_;
    if (!first_) left -= std::min(left, coarse_now_ns() - started_ns_);
    first_ = false;
    if (left == 0) return false;
    return sleep_until_deadline(word, expected, started_ns_ + bound_ns_, left);
}

void RealAtomics::futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected,
                             std::uint64_t deadline) {
    shm::futex_wait(word, expected, deadline);
}

void RealAtomics::futex_wake(std::atomic<std::uint32_t>& word, int max_sleepers) {
    shm::futex_wake(word, max_sleepers);
}

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
#include "shm/os/futex.hpp"

#include "shm/os/sleep_alarm.hpp"

#include <cerrno>
#include <climits>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::shm {

// Not the _PRIVATE operations: the word is shared between processes.

bool futex_wait_timed(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t longest_ns) {
    const timespec longest{static_cast<time_t>(longest_ns / 1'000'000'000ULL),
                           static_cast<long>(longest_ns % 1'000'000'000ULL)};
    return syscall(SYS_futex, &word, FUTEX_WAIT, expected, &longest, nullptr, 0) == 0 || errno != ETIMEDOUT;
}

void futex_wait_forever(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
    syscall(SYS_futex, &word, FUTEX_WAIT, expected, nullptr, nullptr, 0);
}

namespace {

/// Resolution of a few milliseconds, for a sixth of the price.
std::uint64_t coarse_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

bool wait_bounded(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline,
                  std::uint64_t left) {
    if (left >= SleepAlarm::shortest_ns && SleepAlarm::of_process().sleep(word, expected, deadline))
        return true;
    return futex_wait_timed(word, expected, left);
}

} // namespace

void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline) {
    const std::uint64_t now = now_ns();
    if (now < deadline) wait_bounded(word, expected, deadline, deadline - now);
}

BoundedSleep::BoundedSleep(std::chrono::nanoseconds bound)
    : bound_ns_(static_cast<std::uint64_t>(std::clamp(bound, {}, longest_wait).count())),
      started_ns_(coarse_now()) {}

bool BoundedSleep::on(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
    std::uint64_t left = bound_ns_;
    if (!first_) left -= std::min(left, coarse_now() - started_ns_);
    first_ = false;
    if (left == 0) return false;
    return wait_bounded(word, expected, started_ns_ + bound_ns_, left);
}

void futex_wake(std::atomic<std::uint32_t>& word, int sleepers) {
    syscall(SYS_futex, &word, FUTEX_WAKE, sleepers, nullptr, nullptr, 0);
}

void RealAtomics::futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected,
                             std::uint64_t deadline) {
    shm::futex_wait(word, expected, deadline);
}

void RealAtomics::futex_wake(std::atomic<std::uint32_t>& word, int sleepers) {
    shm::futex_wake(word, sleepers);
}

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
#include "shm/futex.hpp"

#include <cerrno>
#include <climits>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::shm {

// Not the _PRIVATE operations: the word is shared between processes.

void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline) {
    const std::uint64_t now = now_ns();
    if (now >= deadline) return;
    timespec left{};
    left.tv_sec = static_cast<time_t>((deadline - now) / 1'000'000'000ULL);
    left.tv_nsec = static_cast<long>((deadline - now) % 1'000'000'000ULL);
    syscall(SYS_futex, &word, FUTEX_WAIT, expected, &left, nullptr, 0);
}

namespace {

/// Resolution of a few milliseconds, for a sixth of the price.
std::uint64_t coarse_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

} // namespace

BoundedSleep::BoundedSleep(std::chrono::nanoseconds bound)
    : bound_ns_(static_cast<std::uint64_t>(std::clamp(bound, {}, longest_wait).count())),
      started_ns_(coarse_now()) {}

bool BoundedSleep::on(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
    std::uint64_t left = bound_ns_;
    if (!first_) left -= std::min(left, coarse_now() - started_ns_);
    first_ = false;
    if (left == 0) return false;
    const timespec relative{static_cast<time_t>(left / 1'000'000'000ULL),
                            static_cast<long>(left % 1'000'000'000ULL)};
    return syscall(SYS_futex, &word, FUTEX_WAIT, expected, &relative, nullptr, 0) == 0 || errno != ETIMEDOUT;
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

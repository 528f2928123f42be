// SPDX-License-Identifier: Apache-2.0
// The futex system calls on a word that several processes share, so not the _PRIVATE variants.
#pragma once
#include <atomic>
#include <cstdint>

namespace tandem::shm {

/// Sleeps while `word` holds `expected`. Returns false after `timeout_ns`; returns true when it is woken or a signal comes.
bool futex_wait_timed(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t timeout_ns);

/// Sleeps without a timeout and sets no kernel timer.
void futex_wait_forever(std::atomic<std::uint32_t>& word, std::uint32_t expected);

/// Wakes up to `max_sleepers` threads that sleep on `word`.
void futex_wake(std::atomic<std::uint32_t>& word, int max_sleepers);

} // namespace tandem::shm

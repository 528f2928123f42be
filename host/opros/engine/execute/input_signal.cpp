// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/input_signal.hpp"

#include <ctime>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::engine {

void InputSignal::arrived() {
    if (state_.exchange(set) == asleep)
        syscall(SYS_futex, &state_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

/// Clears the signal. True if it was set; otherwise the executor counts as asleep from here on. One step each, so that an
/// arrival either is seen here or finds the executor asleep.
bool InputSignal::take() {
    std::uint32_t seen = clear;
    if (state_.compare_exchange_strong(seen, asleep) || seen == asleep) return false;
    state_.exchange(clear); // reads the value, and so sees what whoever set it last has done before
    return true;
}

/// The kernel compares once more: an arrival before that ends the sleep at once.
void InputSignal::sleep(const timespec* timeout) {
    syscall(SYS_futex, &state_, FUTEX_WAIT_PRIVATE, static_cast<std::uint32_t>(asleep), timeout, nullptr, 0);
}

void InputSignal::wait() {
    while (!take()) sleep(nullptr);
}

bool InputSignal::wait_for(std::chrono::nanoseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    for (;;) {
        if (take()) return true;
        const auto left = std::chrono::nanoseconds(deadline - std::chrono::steady_clock::now());
        if (left <= std::chrono::nanoseconds::zero()) break;
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
        const timespec how_long{seconds.count(), (left - seconds).count()};
        sleep(&how_long);
    }
    // An arrival may have come since; it is not lost.
    return state_.exchange(clear) == set;
}

} // namespace tandem::engine

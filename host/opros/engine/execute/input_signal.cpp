// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/input_signal.hpp"

namespace tandem::engine {

void InputSignal::arrived() {
    if (pending_.exchange(true)) return; // whoever has set it before wakes the executor
    // The empty critical section orders this behind a waiter that has found pending_ false but does not sleep
    // yet: without it the notification could come in between and be lost.
    { const std::lock_guard<std::mutex> lock(mutex_); }
    wake_.notify_one();
}

void InputSignal::wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    wake_.wait(lock, [this] { return pending_.load(); });
    pending_.exchange(false); // reads the value, and so sees what whoever set it has done before
}

bool InputSignal::wait_for(std::chrono::nanoseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    wake_.wait_for(lock, timeout, [this] { return pending_.load(); });
    return pending_.exchange(false);
}

} // namespace tandem::engine

// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/input_signal.hpp"

namespace tandem::engine {

void InputSignal::arrived() {
    if (pending_.exchange(true)) return; // whoever set it wakes the executor
    { const std::lock_guard<std::mutex> between_look_and_sleep(mutex_); }
    wake_.notify_one();
}

bool InputSignal::wait_for(std::chrono::nanoseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    wake_.wait_for(lock, timeout, [this] { return pending_.load(); });
    return pending_.exchange(false);
}

} // namespace tandem::engine

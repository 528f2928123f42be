// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/arrival.hpp"

namespace tandem::engine {

void Arrival::arrived() {
    if (pending_.exchange(true)) return; // whoever set it wakes the executor
    { const std::lock_guard<std::mutex> between_look_and_sleep(mutex_); }
    wake_.notify_one();
}

bool Arrival::wait(std::chrono::nanoseconds bound) {
    std::unique_lock<std::mutex> lock(mutex_);
    wake_.wait_for(lock, bound, [this] { return pending_.load(); });
    return pending_.exchange(false);
}

} // namespace tandem::engine

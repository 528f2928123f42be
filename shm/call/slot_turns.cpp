// SPDX-License-Identifier: Apache-2.0
#include "shm/call/slot_turns.hpp"

namespace tandem::shm {

SlotTurns::Turn::Turn(SlotTurns& turns) : turns_(turns) {
    const std::lock_guard lock(turns_.mutex_);
    place_ = turns_.waiting_.insert(turns_.waiting_.end(), this);
    turns_.count_.fetch_add(1, std::memory_order_relaxed);
}

SlotTurns::Turn::~Turn() {
    const std::lock_guard lock(turns_.mutex_);
    turns_.waiting_.erase(place_);
    turns_.count_.fetch_sub(1, std::memory_order_relaxed);
    // Another slot may be free, whose release has woken this caller.
    if (!turns_.waiting_.empty()) turns_.waiting_.front()->woken_.notify_one();
}

bool SlotTurns::Turn::wait(std::chrono::nanoseconds bound) {
    std::unique_lock lock(turns_.mutex_);
    woken_.wait_for(lock, bound);
    return turns_.waiting_.front() == this;
}

bool SlotTurns::Turn::has_come() const {
    const std::lock_guard lock(turns_.mutex_);
    return turns_.waiting_.front() == this;
}

void SlotTurns::wake_first() {
    const std::lock_guard lock(mutex_);
    if (!waiting_.empty()) waiting_.front()->woken_.notify_one();
}

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/doorbell_turn.hpp"

#include <chrono>
#include <mutex>
#include <utility>

namespace tandem::link {
namespace {

// The notifier leaves as soon as it gets a processor. But the peer also writes the doorbell's words and may have
// damaged them.
constexpr std::chrono::milliseconds longest_hand_over{100};

/// Makes the thread that waits in the session check again. Always makes a system call, because the words may be
/// damaged.
void end_wait(LinkSession& session) { session.segment()->doorbell().interrupt(); }

} // namespace

void DoorbellTurn::set_sole_consumer(const void* consumer) {
    const std::lock_guard lock(mutex_);
    if (sole_consumer_ != consumer) take_turn_from(holder_);
    sole_consumer_ = consumer;
}

/// Requires the mutex.
void DoorbellTurn::take_turn_from(const void* consumer) {
    if (!consumer || holder_ != consumer) return;
    holder_ = nullptr;
    if (entered_) end_wait(*entered_);
    notifier_may_begin_.notify_one();
}

void DoorbellTurn::await() {
    std::unique_lock lock(mutex_);
    notifier_waits_ = true;
    notifier_may_begin_.wait(lock, [this] { return stopped_ || (!holder_ && !entered_); });
    notifier_waits_ = false;
}

bool DoorbellTurn::begin(LinkSession& session) {
    const std::lock_guard lock(mutex_);
    if (holder_ || entered_) return false;
    entered_ = &session;
    return true;
}

DoorbellTurn::Result DoorbellTurn::begin(LinkSession& session, const void* consumer) {
    std::unique_lock lock(mutex_);
    if (stopped_ || sole_consumer_ != consumer) return Result::refused;
    holder_ = consumer;
    if (entered_) {
        end_wait(*entered_);
        ++waiting_consumers_;
        doorbell_left_.wait_for(lock, longest_hand_over, [this] { return !entered_; });
        --waiting_consumers_;
        if (stopped_ || entered_) take_turn_from(consumer);
        if (holder_ != consumer) return Result::refused;
    }
    if (std::exchange(woken_, false)) return Result::woken;
    entered_ = &session;
    return Result::begun;
}

void DoorbellTurn::end() {
    const rt::ShortLock lock(mutex_);
    entered_ = nullptr;
    if (notifier_waits_ && !holder_) notifier_may_begin_.notify_one();
    if (waiting_consumers_ != 0) doorbell_left_.notify_all();
}

void DoorbellTurn::give_up(const void* consumer) {
    const std::lock_guard lock(mutex_);
    take_turn_from(consumer);
}

void DoorbellTurn::wake(const void* consumer) {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    if (entered_ && holder_ == consumer) end_wait(*entered_);
}

void DoorbellTurn::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    take_turn_from(holder_);
    notifier_may_begin_.notify_one();
    doorbell_left_.notify_all();
}

} // namespace tandem::link

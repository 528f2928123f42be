// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/input_signal.hpp"

#include <ctime>
#include <linux/futex.h>
#include <mutex>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::engine {

/// Prevents the withdrawal of the waiter while this object lives. get() returns nullptr if there is no waiter.
class InputSignal::WaiterUse {
  public:
    explicit WaiterUse(InputSignal& signal) : signal_(signal) {
        const rt::ShortLock lock(signal.waiter_mutex_);
        waiter_ = signal.used_waiter_ = signal.waiter_;
    }
    ~WaiterUse() {
        if (!waiter_) return;
        const rt::ShortLock lock(signal_.waiter_mutex_);
        signal_.used_waiter_ = nullptr;
        if (signal_.waiter_ != waiter_) signal_.waiter_left_.notify_all();
    }
    WaiterUse(const WaiterUse&) = delete;
    WaiterUse& operator=(const WaiterUse&) = delete;
    ArrivalWaiter* get() const { return waiter_; }

  private:
    InputSignal& signal_;
    ArrivalWaiter* waiter_ = nullptr;
};

void InputSignal::arrived() {
    const std::uint32_t before = state_.exchange(set);
    if (before == asleep) syscall(SYS_futex, &state_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
    if (before == in_waiter) wake_waiter();
}

void InputSignal::wake_waiter() {
    const std::lock_guard lock(waiter_mutex_);
    if (waiter_) waiter_->wake(*this); // the executor has left a withdrawn waiter, or is about to leave it
}

bool InputSignal::offerWaiter(ArrivalWaiter* waiter) {
    const std::lock_guard lock(waiter_mutex_);
    if (!waiter_) waiter_ = waiter;
    return waiter_ == waiter;
}

void InputSignal::withdrawWaiter(ArrivalWaiter* waiter) {
    std::unique_lock lock(waiter_mutex_);
    if (waiter_ != waiter) return;
    waiter_ = nullptr;
    if (used_waiter_ == waiter) waiter->wake(*this);
    waiter_left_.wait(lock, [&] { return used_waiter_ != waiter; });
}

/// Clears the signal. Returns true if it was set. Otherwise sets the state to `otherwise` and returns false. Each of
/// the two is one atomic step, so an arrival is either seen here or finds the executor asleep.
bool InputSignal::take(State otherwise) {
    std::uint32_t seen = clear;
    while (seen != set)
        if (state_.compare_exchange_strong(seen, otherwise)) return false;
    state_.exchange(clear); // reads the value, too, and so sees all earlier writes of the thread that set it
    return true;
}

/// The kernel compares the word once more. So an arrival before the sleep ends it at once.
void InputSignal::sleep(const timespec* timeout) {
    syscall(SYS_futex, &state_, FUTEX_WAIT_PRIVATE, static_cast<std::uint32_t>(asleep), timeout, nullptr, 0);
}

void InputSignal::wait() {
    for (;;) {
        ArrivalWaiter::Result result = ArrivalWaiter::REFUSED;
        if (const WaiterUse use(*this); use.get()) {
            if (take(in_waiter)) return;
            result = use.get()->wait(*this);
        }
        if (result == ArrivalWaiter::ARRIVED) {
            state_.exchange(clear); // merges any other arrival of the meantime into this one
            return;
        }
        if (result == ArrivalWaiter::WOKEN) continue;
        if (take(asleep)) return;
        sleep(nullptr);
    }
}

bool InputSignal::wait_for(std::chrono::nanoseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    for (;;) {
        if (take(asleep)) return true;
        const auto left = std::chrono::nanoseconds(deadline - std::chrono::steady_clock::now());
        if (left <= std::chrono::nanoseconds::zero()) break;
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
        const timespec how_long{seconds.count(), (left - seconds).count()};
        sleep(&how_long);
    }
    // An arrival may have come since then. It is not lost.
    return state_.exchange(clear) == set;
}

} // namespace tandem::engine

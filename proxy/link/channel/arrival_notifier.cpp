// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/arrival_notifier.hpp"

#include <chrono>

namespace tandem::link {

using namespace std::chrono_literals;

void ArrivalNotifier::set_listener(const std::string& port, std::function<void()> listener) {
    const std::lock_guard lock(mutex_);
    listeners_.erase(port);
    if (!listener || stopping_) return;
    listeners_[port].arrived = std::move(listener);
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void ArrivalNotifier::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true; // from here on no thread is started
    }
    if (thread_.joinable()) thread_.join();
}

void ArrivalNotifier::run() {
    while (!state_.is_closing()) {
        // Returns at once when the session ends, which interrupts the doorbell, and so lets go of it.
        if (const auto session = state_.wait_for_session(100ms))
            session->segment()->doorbell().wait(1s, wait_);
        // Also without a ring of the bell: messages that were written before the peer knew of this listener,
        // or by a peer that died between message and ring, are noticed after the bound.
        notify();
    }
}

/// The writer's counter says whether anything came since the last look, even if the consumer has read it
/// already or leaves it unread.
void ArrivalNotifier::notify() {
    const std::lock_guard lock(mutex_);
    for (auto& [port, listener] : listeners_) {
        const std::uint64_t sent = channels_.reader(port).counters().sent;
        if (sent == listener.seen) continue;
        listener.seen = sent;
        if (sent != 0) listener.arrived(); // 0: a ring of a new session, or none
    }
}

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/arrival_notifier.hpp"

#include <chrono>
#include <pthread.h>

namespace tandem::link {

using namespace std::chrono_literals;

void ArrivalNotifier::set_listener(const ChannelReader& channel, std::function<void()> listener) {
    {
        const std::lock_guard lock(mutex_);
        listeners_.erase(&channel);
        if (!listener || stopping_) return;
        listeners_[&channel].arrived = std::move(listener);
        rung_in_.reset();
        if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
    }
    wake();
}

void ArrivalNotifier::set_peer_rings(const std::shared_ptr<LinkSession>& session, bool rings) {
    {
        const std::lock_guard lock(mutex_);
        rung_in_ = rings ? session : nullptr;
    }
    wake(); // messages that the peer wrote before it rang are looked for now
}

/// Makes the thread look at the counters and decide anew how long it sleeps.
void ArrivalNotifier::wake() {
    if (const auto session = state_.session()) session->segment()->doorbell().ring(message_bit);
}

void ArrivalNotifier::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true; // from here on no thread is started
    }
    if (thread_.joinable()) thread_.join();
}

void ArrivalNotifier::run() {
    pthread_setname_np(pthread_self(), "tandem-arrivals");
    while (!state_.is_closing()) {
        // Returns at once when the session ends, which interrupts the doorbell, and so lets go of it.
        if (const auto session = state_.wait_for_session())
            session->segment()->doorbell().wait(look_again_in(session), wait_);
        notify();
    }
}

/// Forever, unless there may be messages that the peer did not ring for. PeerSupervisor rings when the link is up.
std::chrono::nanoseconds ArrivalNotifier::look_again_in(const std::shared_ptr<LinkSession>& session) {
    const std::lock_guard lock(mutex_);
    const bool rung = !state_.is_up() || listeners_.empty() || rung_in_.lock() == session;
    return rung ? shm::longest_wait : std::chrono::nanoseconds(1s);
}

/// The writer's counter says whether anything came since the last look, even if the consumer has read it
/// already or leaves it unread.
void ArrivalNotifier::notify() {
    const std::lock_guard lock(mutex_);
    for (auto& [channel, listener] : listeners_) {
        const std::uint64_t sent = channel->counters().sent;
        if (sent == listener.seen) continue;
        listener.seen = sent;
        if (sent != 0) listener.arrived(); // 0: a ring of a new session, or none
    }
}

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/arrival_notifier.hpp"

#include "host/process/start_thread.hpp"
#include "proxy/link/session/link_thread.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>

namespace tandem::link {

using namespace std::chrono_literals;

void ArrivalNotifier::set_listener(const ChannelReader& channel, std::function<void()> listener,
                                   const void* consumer) {
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(listeners_, [&](const Listener& each) { return each.channel == &channel; });
        const bool listens = listener && !stopping_;
        if (listens) listeners_.push_back({&channel, std::move(listener), consumer});
        turn_.set_sole_consumer(sole_consumer());
        if (!listens) return;
        rung_in_.reset();
        if (!thread_.joinable()) thread_ = process::start_thread([this] { run(); });
    }
    wake();
}

void ArrivalNotifier::set_peer_rings(const std::shared_ptr<LinkSession>& session, bool rings) {
    {
        const std::lock_guard lock(mutex_);
        rung_in_ = rings ? session : nullptr;
    }
    wake(); // looks now for messages that the peer wrote before it rang
}

/// Returns nullptr if there is no consumer or more than one. Requires the mutex.
const void* ArrivalNotifier::sole_consumer() const {
    if (listeners_.empty()) return nullptr;
    const void* const first = listeners_.front().consumer;
    const bool same = std::all_of(listeners_.begin(), listeners_.end(),
                                  [&](const auto& each) { return each.consumer == first; });
    return same ? first : nullptr;
}

/// Makes the waiting thread check the counters and recompute how long it sleeps.
void ArrivalNotifier::wake() {
    if (const auto session = state_.session()) session->segment()->doorbell().ring(message_bit);
}

void ArrivalNotifier::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true; // from here on, no thread is started
    }
    turn_.stop();
    if (thread_.joinable()) thread_.join();
}

void ArrivalNotifier::run() {
    begin_link_thread("tandem-arrivals");
    while (!state_.is_closing()) {
        turn_.await();
        // Returns at once when the session ends: that interrupts the doorbell, so this thread releases the session.
        if (const auto session = state_.wait_for_session(); session && turn_.begin(*session))
            wait_at_doorbell(session);
        notify(nullptr);
    }
}

/// Called after begin(); calls end().
void ArrivalNotifier::wait_at_doorbell(const std::shared_ptr<LinkSession>& session) {
    session->segment()->doorbell().wait(look_again_in(session), wait_);
    turn_.end();
}

ArrivalNotifier::Wait ArrivalNotifier::wait_as(const void* consumer) {
    const auto session = state_.session();
    if (!session || state_.is_closing()) {
        turn_.give_up(consumer); // the thread waits for the next session
        return Wait::refused;
    }
    const auto turn = turn_.begin(*session, consumer);
    if (turn == DoorbellTurn::Result::refused) return Wait::refused;
    if (turn == DoorbellTurn::Result::begun) wait_at_doorbell(session);
    return notify(consumer) ? Wait::arrived : Wait::woken;
}

/// Returns the longest wait, unless there may be messages for which the peer did not ring. PeerSupervisor rings when
/// the link comes up.
std::chrono::nanoseconds ArrivalNotifier::look_again_in(const std::shared_ptr<LinkSession>& session) {
    const std::lock_guard lock(mutex_);
    const bool rung = !state_.is_up() || listeners_.empty() || rung_in_.lock() == session;
    return rung ? shm::longest_wait : std::chrono::nanoseconds(1s);
}

/// The writer's counter shows whether a message has arrived since the last check, even if the consumer has already
/// read it or leaves it unread. Returns true if it is for the calling consumer, whose listeners are not called.
bool ArrivalNotifier::notify(const void* consumer) {
    bool arrived = false;
    const rt::ShortLock lock(mutex_);
    for (Listener& listener : listeners_) {
        const std::uint64_t sent = listener.channel->sent();
        if (sent == listener.seen) continue;
        listener.seen = sent;
        if (sent == 0) continue; // the ring of a new session, or no ring
        if (consumer && listener.consumer == consumer)
            arrived = true;
        else
            listener.arrived();
    }
    return arrived;
}

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"
#include "proxy/link/session/link_session.hpp"

#include <condition_variable>

namespace tandem::link {

/// Which thread waits on this side's doorbell, which has one owner: the notifier, unless all messages are for one consumer
/// whose thread waits by itself. That one keeps the turn also while it works, and the notifier sleeps.
class DoorbellTurn {
  public:
    enum class Result { begun, refused, woken };

    /// The consumer that all messages are for; nullptr: none, or several. Any other one loses the turn. [any-thread]
    void set_sole_consumer(const void* consumer);

    /// Waits until no consumer has the turn, or stop(). [notifier-thread]
    void await();
    /// True: the notifier may wait in this session until end(). [notifier-thread]
    bool begin(LinkSession& session);
    /// The same for a consumer, which takes the turn. refused: it may not have it, or the notifier did not leave in time;
    /// woken: wake() was called. [the consumer's thread]
    Result begin(LinkSession& session, const void* consumer);
    /// After each begin() that has begun a wait.
    void end();

    /// Gives the turn back to the notifier. [the consumer's thread]
    void give_up(const void* consumer);
    /// Ends the consumer's wait, now or the next. [any-thread]
    void wake(const void* consumer);
    /// No consumer gets the turn any more, and await() returns. [any-thread]
    void stop();

  private:
    void take_turn_from(const void* consumer);

    rt::ShortMutex mutex_; ///< a leaf: no other lock is taken while it is held
    std::condition_variable_any notifier_may_begin_, doorbell_left_;
    const void* sole_consumer_ = nullptr;
    const void* holder_ = nullptr;   ///< the consumer that has the turn; nullptr: the notifier
    LinkSession* entered_ = nullptr; ///< where somebody waits, who keeps it alive until end()
    /// Who waits for the conditions: end() is between a message and its consumer, and signals nobody in vain.
    bool notifier_waits_ = false;
    int waiting_consumers_ = 0;
    bool woken_ = false, stopped_ = false;
};

} // namespace tandem::link

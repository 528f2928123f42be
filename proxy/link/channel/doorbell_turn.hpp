// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"
#include "proxy/link/session/link_session.hpp"

#include <condition_variable>

namespace tandem::link {

/// Decides which thread waits on this side's doorbell, which has only one owner: the notifier, unless all messages
/// are for one consumer whose own thread waits. This consumer keeps the turn while it works, and the notifier sleeps.
/// A `const void* consumer` only identifies a consumer.
class DoorbellTurn {
  public:
    enum class Result { begun, refused, woken };

    /// Sets the consumer of all messages; nullptr: none or several. Any other consumer loses the turn. [any-thread]
    void set_sole_consumer(const void* consumer);

    /// Waits until no consumer has the turn, or stop() is called. [notifier-thread]
    void await();
    /// Returns true if the notifier may wait in this session until end(). [notifier-thread]
    bool begin(LinkSession& session);
    /// Takes the turn for a consumer. Returns refused if another thread has the turn or the notifier does not
    /// leave in time, and woken if wake() was called. [the consumer's thread]
    Result begin(LinkSession& session, const void* consumer);
    /// Ends the wait of a successful begin(). Call it after each of them.
    void end();

    /// Gives the turn back to the notifier. [the consumer's thread]
    void give_up(const void* consumer);
    /// Ends this consumer's current wait, and makes the next begin() of a consumer return woken. [any-thread]
    void wake(const void* consumer);
    /// Gives the turn to no consumer from now on, and makes await() return. [any-thread]
    void stop();

  private:
    void take_turn_from(const void* consumer);

    rt::ShortMutex mutex_; ///< a leaf: no other lock is locked while it is held
    std::condition_variable_any notifier_may_begin_, doorbell_left_;
    const void* sole_consumer_ = nullptr;
    const void* holder_ = nullptr; ///< the consumer that has the turn; nullptr: the notifier
    /// The session in which a thread waits. The thread keeps it alive until end().
    LinkSession* entered_ = nullptr;
    /// Which threads wait for the conditions. end() runs between a message and its consumer, so it only notifies a
    /// condition with a waiting thread.
    bool notifier_waits_ = false;
    int waiting_consumers_ = 0;
    bool woken_ = false, stopped_ = false;
};

} // namespace tandem::link

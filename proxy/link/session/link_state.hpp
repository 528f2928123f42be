// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"
#include "proxy/link/session/link_session.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace tandem::link {

/// What the threads of one link tell each other: the current session, whether the link is up, why the peer
/// was refused, whether the link is closing. PeerSupervisor changes it, the others read it and wait for
/// changes. All functions are [any-thread].
class LinkState {
  public:
    /// True from the moment at which data and calls may flow until the session ends.
    bool is_up() const { return up_.load(std::memory_order_acquire); }
    /// How often the link has come up: names a connection. It changes before is_up() is true.
    std::uint64_t connections() const { return connections_.load(std::memory_order_acquire); }
    bool is_closing() const { return closing_.load(std::memory_order_acquire); }

    /// The current session; nullptr while none is joined. A caller keeps the pointer only as long as it works
    /// in the segment, since the side is given back with the last one.
    std::shared_ptr<LinkSession> session() const;
    /// The same, but nullptr unless the link is up.
    std::shared_ptr<LinkSession> connected_session() const;
    /// The same as session(), after waiting for one to be joined, or for the link to close.
    std::shared_ptr<LinkSession> wait_for_session() const;

    struct UpResult {
        bool up;
        std::string refusal; ///< why the peer was refused, one line; empty if it was not
    };
    /// Waits until the link is up, or the peer is refused, or the link is closing, at most `timeout`.
    UpResult wait_until_up(std::chrono::milliseconds timeout) const;
    /// The same for work that belongs to the current session: returns also when there is none any more.
    void wait_until_session_is_up(std::chrono::milliseconds timeout) const;
    void wait_until_closing(std::chrono::milliseconds timeout) const;

    // [supervisor-thread]
    void start_session(std::shared_ptr<LinkSession> session);
    void set_up();
    void set_refused(std::string reason);
    /// Shuts the session down and forgets it. Returns whether the link was up.
    bool end_session();

    /// Makes every wait of this class return, now and from now on. False if it was called before.
    bool start_closing();

  private:
    mutable std::mutex mutex_;
    /// Of session_ and up_ alone, which each call asks for: whoever changes them holds both mutexes.
    mutable rt::ShortMutex connected_mutex_;
    mutable std::condition_variable changed_; ///< notified with mutex_ held, after each change of the members
    std::shared_ptr<LinkSession> session_;
    std::string refusal_;
    std::atomic<std::uint64_t> connections_{0};
    std::atomic<bool> up_{false}, closing_{false}; ///< written with mutex_ held, so that no waiter misses it
};

} // namespace tandem::link

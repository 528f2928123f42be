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

/// The state that the threads of one link share: the current session, whether the link is up, why the peer was
/// refused, and whether the link is closing. PeerSupervisor changes it; the others read it and wait for changes.
/// [any-thread]
class LinkState {
  public:
    /// Returns true from the moment when data and calls may flow until the session ends.
    bool is_up() const { return up_.load(std::memory_order_acquire); }
    /// Returns how often the link has come up, which identifies a connection. Changes before is_up() becomes true.
    std::uint64_t connections() const { return connections_.load(std::memory_order_acquire); }
    bool is_closing() const { return closing_.load(std::memory_order_acquire); }

    /// Returns the current session, or nullptr. Keep the pointer only while working in the segment: releasing the
    /// last pointer releases the side.
    std::shared_ptr<LinkSession> session() const;
    /// Returns the current session, or nullptr unless the link is up.
    std::shared_ptr<LinkSession> connected_session() const;
    /// Waits until a session is joined or the link closes, then returns the session like session().
    std::shared_ptr<LinkSession> wait_for_session() const;

    struct UpResult {
        bool up;
        std::string refusal; ///< why the peer was refused, one line; empty if it was not
    };
    /// Waits, at most `timeout`, until the link is up, the peer is refused, or the link is closing.
    UpResult wait_until_up(std::chrono::milliseconds timeout) const;
    /// Waits like wait_until_up(), for work that belongs to the current session. Also returns when the session is
    /// gone.
    void wait_until_session_is_up(std::chrono::milliseconds timeout) const;
    void wait_until_closing(std::chrono::milliseconds timeout) const;

    // [supervisor-thread]
    void start_session(std::shared_ptr<LinkSession> session);
    void set_up();
    void set_refused(std::string reason);
    /// Shuts the session down and releases it. Returns true if the link was up.
    bool end_session();

    /// Makes every wait of this class return from now on. Returns false if it has been called before.
    bool start_closing();

  private:
    mutable std::mutex mutex_;
    /// Guards only session_ and up_, which each call reads. A thread that changes them holds both mutexes.
    mutable rt::ShortMutex connected_mutex_;
    mutable std::condition_variable changed_; ///< notified with mutex_ held, after each change of the members
    std::shared_ptr<LinkSession> session_;
    std::string refusal_;
    std::atomic<std::uint64_t> connections_{0};
    std::atomic<bool> up_{false}, closing_{false}; ///< written with mutex_ held: no waiting thread misses it
};

} // namespace tandem::link

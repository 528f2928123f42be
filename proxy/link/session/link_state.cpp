// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/session/link_state.hpp"

#include <utility>

namespace tandem::link {

std::shared_ptr<LinkSession> LinkState::session() const {
    const std::lock_guard lock(mutex_);
    return session_;
}

std::shared_ptr<LinkSession> LinkState::connected_session() const {
    const std::lock_guard lock(connected_mutex_);
    return up_.load(std::memory_order_relaxed) ? session_ : nullptr;
}

std::shared_ptr<LinkSession> LinkState::wait_for_session() const {
    {
        // Usually there is a session. Then a short lock suffices.
        const std::lock_guard lock(connected_mutex_);
        if (session_) return session_;
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return session_ || closing_; });
    return session_;
}

LinkState::UpResult LinkState::wait_until_up(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return up_ || !refusal_.empty() || closing_; });
    return {up_, refusal_};
}

void LinkState::wait_until_session_is_up(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return up_ || !refusal_.empty() || !session_ || closing_; });
}

void LinkState::wait_until_closing(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return closing_.load(); });
}

void LinkState::start_session(std::shared_ptr<LinkSession> session) {
    const std::lock_guard lock(mutex_);
    const std::lock_guard connected_lock(connected_mutex_);
    session_ = std::move(session);
    changed_.notify_all();
}

void LinkState::set_up() {
    const std::lock_guard lock(mutex_);
    const std::lock_guard connected_lock(connected_mutex_);
    ++connections_;
    up_.store(true, std::memory_order_release);
    refusal_.clear();
    changed_.notify_all();
}

void LinkState::set_refused(std::string reason) {
    const std::lock_guard lock(mutex_);
    refusal_ = std::move(reason);
    changed_.notify_all();
}

bool LinkState::end_session() {
    std::shared_ptr<LinkSession> ended; // destroyed after the lock: leaving the segment takes system calls
    const std::lock_guard lock(mutex_);
    const std::lock_guard connected_lock(connected_mutex_);
    const bool was_up = up_.exchange(false);
    refusal_.clear();
    ended = std::move(session_);
    // Under the lock, so that no thread waits in this session after taking it for the current one.
    if (ended) ended->shut_down();
    changed_.notify_all();
    return was_up;
}

bool LinkState::start_closing() {
    const std::lock_guard lock(mutex_);
    if (closing_.exchange(true)) return false; // both close() and the destructor call this
    if (session_) session_->interrupt();
    changed_.notify_all();
    return true;
}

} // namespace tandem::link

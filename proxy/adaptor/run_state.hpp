// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

namespace tandem::adaptor {

/// Whether AdaptorComp runs the RTCs, and whether it may start by itself. Each change is one step, so that an error that is
/// reported during a stop cannot undo the stop. [any-thread]
class RunState {
  public:
    /// Begins a start. Returns false if it is a restart that the user has since withdrawn.
    bool begin_start(bool is_restart) {
        const std::lock_guard lock(mutex_);
        if (is_restart && state_ != State::restart_wanted) return false;
        state_ = State::starting;
        return true;
    }
    /// Notes that the RTCs are active, unless one has failed since begin_start().
    void activated() { change(State::starting, State::running); }
    /// Ends a start. Returns false if the RTCs are not active; a restart is then wanted.
    bool end_start() {
        const std::lock_guard lock(mutex_);
        if (state_ == State::starting) state_ = State::restart_wanted;
        return state_ == State::running;
    }
    /// Notes that an RTC has failed. Returns true if the RTCs were running. Does nothing after a stop.
    bool fail() {
        const std::lock_guard lock(mutex_);
        const bool was_running = state_ == State::running;
        if (was_running || state_ == State::starting) state_ = State::restart_wanted;
        return was_running;
    }
    /// Notes that AdaptorComp has gone to ERROR. A restart stays wanted if an RTC was the reason.
    void enter_error() { change(State::running, State::user_decides); }
    /// Notes that the user has stopped or recovered AdaptorComp: from here on, it does not start by itself.
    void let_user_decide() {
        const std::lock_guard lock(mutex_);
        state_ = State::user_decides;
    }
    /// Returns true if a restart was wanted. It is not wanted any more.
    bool withdraw_restart() { return change(State::restart_wanted, State::user_decides); }

    bool is_running() const { return is(State::running); }
    bool is_restart_wanted() const { return is(State::restart_wanted); }

  private:
    enum class State { user_decides, starting, running, restart_wanted };
    bool change(State from, State to) {
        const std::lock_guard lock(mutex_);
        if (state_ != from) return false;
        state_ = to;
        return true;
    }
    bool is(State state) const {
        const std::lock_guard lock(mutex_);
        return state_ == state;
    }

    mutable std::mutex mutex_;
    State state_ = State::user_decides;
};

} // namespace tandem::adaptor

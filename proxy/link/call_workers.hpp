// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/sized_thread.hpp"
#include "proxy/link/link_handler.hpp"
#include "proxy/link/session/link_options.hpp"
#include "proxy/link/session/link_state.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <list>
#include <mutex>
#include <optional>

namespace tandem::link {

/// The worker threads that execute the peer's calls. There is one at first. Whenever the last idle worker takes a call,
/// another worker starts, up to max_workers or the limit of threads, so that calls nested in both directions cannot block each
/// other. Workers that have not been needed for long end. Workers outlive sessions: they take calls from the current session.
class CallWorkers {
  public:
    /// `wake_supervisor` makes the supervisor thread look for the peer now. All references must outlive this object.
    CallWorkers(const LinkOptions& options, const LinkState& state, LinkHandler& handler,
                std::function<void()> wake_supervisor);
    ~CallWorkers() { stop(); }
    CallWorkers(const CallWorkers&) = delete;
    CallWorkers& operator=(const CallWorkers&) = delete;

    void start();
    /// Waits for the calls that are being executed. Call it after LinkState::start_closing(). [not in a worker]
    void stop();

  private:
    using Clock = std::chrono::steady_clock;
    void run();
    std::optional<shm::IncomingCall> take_call() const;
    void note_need(unsigned idle);
    bool ends_this_worker();
    ReplyView serve(const shm::IncomingCall& call, wire::MessageBuffer& memory);
    void start_another_worker();
    void start_worker(); ///< requires mutex_

    const LinkOptions& options_;
    const LinkState& state_;
    LinkHandler& handler_;
    const std::function<void()> wake_supervisor_;
    std::atomic<unsigned> idle_{0};         ///< workers that execute no call
    std::atomic<std::size_t> count_{0};     ///< of threads_
    std::atomic<Clock::time_point> needed_; ///< last time with at most one idle worker among more than two
    std::mutex mutex_;                      ///< guards the members below
    std::list<process::SizedThread> threads_, ended_;
    bool stopping_ = false;
    bool has_warned_ = false; ///< of a worker that could not be started
    Clock::time_point retry_at_{};
};

} // namespace tandem::link

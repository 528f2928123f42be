// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link_handler.hpp"
#include "proxy/link/session/link_state.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tandem::link {

/// The worker threads that execute the peer's calls. There is one at first. Whenever the last idle worker takes a call,
/// another worker starts, up to max_workers or the limit of threads, so that calls nested in both directions cannot block each
/// other. Workers outlive sessions: they take calls from the current session.
class CallWorkers {
  public:
    /// `wake_supervisor` makes the supervisor thread look for the peer now. All references must outlive this object.
    /// `link` is the name for the log.
    CallWorkers(std::string link, const LinkState& state, LinkHandler& handler,
                std::function<void()> wake_supervisor);
    ~CallWorkers() { stop(); }
    CallWorkers(const CallWorkers&) = delete;
    CallWorkers& operator=(const CallWorkers&) = delete;

    void start();
    /// Waits for the calls that are being executed. Call it after LinkState::start_closing(). [not in a worker]
    void stop();

  private:
    void run();
    std::optional<shm::IncomingCall> take_call() const;
    ReplyView serve(const shm::IncomingCall& call, wire::MessageBuffer& memory);
    void start_another_worker();
    void start_worker(); ///< requires mutex_

    const std::string link_;
    const LinkState& state_;
    LinkHandler& handler_;
    const std::function<void()> wake_supervisor_;
    std::atomic<unsigned> idle_{0}; ///< workers that execute no call
    std::mutex mutex_;              ///< guards the members below
    std::vector<std::thread> threads_;
    bool stopping_ = false;
    bool has_warned_ = false; ///< of a worker that could not be started
    std::chrono::steady_clock::time_point retry_at_{};
};

} // namespace tandem::link

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link.hpp"

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace tandem::interceptor {

/// Tells the peer which RTCs went to ERROR or have exited, and that all are active again. Keeps reports that did not reach
/// a peer for the next send().
class FailureReports {
  public:
    /// `call_timeout`: of each call across the link. The link must outlive this object.
    FailureReports(link::Link& link, std::chrono::milliseconds call_timeout)
        : link_(link), call_timeout_(call_timeout) {}

    /// Sends "RTC '...' `what`" in the task thread: the report waits for the peer, and so must not run in the thread of the
    /// RTC's execution context. [any-thread]
    void add(const std::string& rtc, const std::string& what);
    /// Drops the unsent reports about this RTC, because it is active again. [any-thread]
    void withdraw(const std::string& rtc);
    /// Sends the reports that no peer has got yet. [task-thread]
    void send();
    /// Call it when the peer has learned of a failure in another way. [any-thread]
    void set_peer_knows_failure() { peer_knows_failure_ = true; }
    /// Tells a peer that knows of a failure that all RTCs are active. [task-thread]
    void send_recovery();

  private:
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::mutex mutex_;                                    ///< guards unsent_
    std::map<std::string, std::set<std::string>> unsent_; ///< of each RTC, one line each
    std::atomic<bool> peer_knows_failure_{false};
};

} // namespace tandem::interceptor

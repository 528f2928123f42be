// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link.hpp"

#include <chrono>
#include <mutex>
#include <set>
#include <string>

namespace tandem::interceptor {

/// Tells the peer which RTCs went to ERROR or have exited. Keeps reports that did not reach a peer for the next send().
class FailureReports {
  public:
    /// `call_timeout`: of each call across the link. The link must outlive this object.
    FailureReports(link::Link& link, std::chrono::milliseconds call_timeout)
        : link_(link), call_timeout_(call_timeout) {}

    /// Sends "RTC '...' `what`" in the task thread: the report waits for the peer, and so must not run in the thread of the
    /// RTC's execution context. [any-thread]
    void add(const std::string& rtc, const std::string& what);
    /// Sends the reports that no peer has got yet. [task-thread]
    void send();

  private:
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::mutex mutex_;             ///< guards unsent_
    std::set<std::string> unsent_; ///< one line each
};

} // namespace tandem::interceptor

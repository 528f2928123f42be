// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/task_queue.hpp"

#include <string>

namespace tandem::interceptor {

/// An RTC that the link activates, deactivates and resets. Each function returns an empty string or an error of one line,
/// in bounded time. [any-thread]
class DrivenRtc {
  public:
    virtual ~DrivenRtc() = default;
    virtual std::string activate() = 0;
    virtual std::string deactivate() = 0;
    /// Does nothing if the RTC is not in ERROR.
    virtual std::string reset() = 0;
    virtual bool is_active() const = 0;
    /// Sets the queue whose thread calls the functions above from now on. This object may post work there that must run
    /// after them. The thread ends before this object is destroyed.
    virtual void set_thread(link::TaskQueue&) {}
};

} // namespace tandem::interceptor

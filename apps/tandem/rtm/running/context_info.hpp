// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>

#include <string>

namespace tandem::command {

/// What an execution context tells about itself in its profile. [main-thread]
class ContextInfo {
  public:
    /// Asks the context. Of one that has gone, or is not of OpenRTM-aist's kind, nothing is known.
    explicit ContextInfo(RTC::ExecutionContext_ptr context);
    /// `onActivated`: the callback that the component of this instance name has been in for 0.1 s or more; empty when it is in
    /// none, or the host does not tell (only Tandem's does).
    std::string running_callback(const std::string& instance) const;
    /// `onActivated has taken 1.3 s so far`, or empty.
    std::string describe_running_callback(const std::string& instance) const;
    /// Whether the absence of a running callback means that there is none.
    bool tells_callbacks() const { return !property("tick.cycles").empty(); }
    /// Of a cycle, in s; at most 1, for contexts with periods of hours. 0: not known.
    double period_s() const;

  private:
    std::string property(const char* name) const;
    RTC::ExecutionContextProfile_var profile_;
};

/// Whether the component is in a host of Tandem's, and not of OpenRTM-aist's: what both tell differs.
bool is_in_tandem_host(RTC::RTObject_ptr component);

} // namespace tandem::command

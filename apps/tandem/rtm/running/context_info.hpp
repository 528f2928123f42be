// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>

#include <string>

namespace tandem::command {

/// The information in an execution context's profile. [main-thread]
class ContextInfo {
  public:
    /// Queries the context. Nothing is known of a context that is gone or is not an OpenRTM-aist context.
    explicit ContextInfo(RTC::ExecutionContext_ptr context);
    /// Returns the component's callback that has run for 0.1 s or more, such as `onActivated`. Returns an empty text if
    /// there is none, or if the host does not report callbacks (only Tandem's hosts do).
    std::string running_callback(const std::string& instance) const;
    /// Returns `onActivated has taken 1.3 s so far`, or an empty text.
    std::string describe_running_callback(const std::string& instance) const;
    /// Returns whether the context reports callbacks, so that an empty running_callback() means that none is running.
    bool reports_callbacks() const { return !property("tick.cycles").empty(); }
    /// Returns the period in s, at most 1 for contexts with periods of hours; 0 if unknown.
    double period_s() const;

  private:
    std::string property(const char* name) const;
    RTC::ExecutionContextProfile_var profile_;
};

/// Returns whether the component is in a host of Tandem instead of OpenRTM-aist. Their reports differ.
bool is_in_tandem_host(RTC::RTObject_ptr component);

} // namespace tandem::command

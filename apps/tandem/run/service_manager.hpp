// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace tandem::command {

/// Notifies systemd about a run that is a service of Type=notify (sd_notify(3)). Sends nothing in a
/// terminal. [one thread]
class ServiceManager {
  public:
    ServiceManager();
    void report_ready();
    void report_stopping();
    void report_status(const std::string& line);
    /// Sends a keep-alive. Call this at least twice per WatchdogSec= of the unit. Without WatchdogSec= it
    /// sends nothing.
    void keep_alive();

  private:
    std::chrono::microseconds pause_{0}; ///< between two watchdog messages; 0: none
    std::chrono::steady_clock::time_point next_{};
};

} // namespace tandem::command

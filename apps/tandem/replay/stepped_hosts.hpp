// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/hosts/supervisor.hpp"
#include "apps/tandem/replay/commands.hpp"
#include "apps/tandem/run/lockstep.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// The hosts of an application that stay when a replay takes the place of one of them, in lock-step. What they print goes to
/// standard output. [main-thread]
class SteppedHosts {
  public:
    /// Throws std::runtime_error if nothing stays.
    SteppedHosts(const ReplayOptions& options, const std::string& replaced_host);

    /// Starts them and waits until they are ready. Throws std::runtime_error, one line, or hosts::Interrupted.
    void start();
    /// Throws std::runtime_error if the cycle fails or a host has ended, or hosts::Interrupted.
    void step(const std::string& host, const std::string& component);
    /// Ends them. True if all ended in order.
    bool stop();

    /// The components that stay, by the application's own periods, for a recording without steps; and its tick.
    const std::vector<SteppedComponent>& find_components();
    std::chrono::nanoseconds tick() const { return tick_; }

  private:
    void handle(const hosts::Supervisor::Events& events);

    const ReplayOptions& options_;
    const std::string replaced_host_;
    const RunFolder folder_;
    HostSteps steps_;
    std::optional<hosts::Supervisor> supervisor_;
    std::vector<SteppedComponent> components_;
    std::chrono::nanoseconds tick_{0};
    bool stopping_ = false;
    unsigned steps_since_look_ = 0;
};

} // namespace tandem::command

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

/// The other hosts of an application in lock-step, when a replay replaces one host. Their output goes to
/// standard output. [main-thread]
class SteppedHosts {
  public:
    /// Throws std::runtime_error if there is no other host.
    SteppedHosts(const ReplayOptions& options, const std::string& replaced_host);

    /// Starts the hosts and waits until they are ready. Throws std::runtime_error with one line, or
    /// hosts::Interrupted.
    void start();
    /// Runs one cycle. Throws std::runtime_error if it fails or a host has ended, or hosts::Interrupted.
    void step(const std::string& host, const std::string& component);
    /// Passes on the hosts' output. Throws std::runtime_error if a host has ended, or hosts::Interrupted.
    void look();
    /// Stops the hosts. Returns true if all ended normally.
    bool stop();

    /// Returns the components of the other hosts by the application's periods, for a recording without steps.
    const std::vector<SteppedComponent>& find_components();
    /// Returns the shortest period of all components, also of the replaced host; 0 before find_components().
    std::chrono::nanoseconds tick_period() const { return tick_; }

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

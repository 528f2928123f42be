// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/run/run_directory.hpp"
#include "host/rt/step_client.hpp"

namespace tandem::wheelchair {

/// Runs the three components in simulated time. Requests their cycles one after the other, always in the same order
/// (docs/wheelchair.md, section 5.1), so that every run of a scenario gives the same bytes.
class LockstepDriver {
  public:
    /// Connects to the hosts of the run. Throws std::runtime_error if a host does not listen within 5 s.
    LockstepDriver(const RunDirectory& run, Configuration configuration);

    /// Called after each cycle with the host's name and the component's instance name.
    using AfterStep = std::function<void(const std::string& host, const std::string& instance)>;

    /// Runs one cycle of JoystickComp, ControlComp and HWComp. Omits HWComp in the last tick, because its log row ends
    /// before HWComp. Throws std::runtime_error with the host's message.
    void run_tick(bool last, const AfterStep& after_step);

  private:
    /// A cycle within a tick.
    struct Step {
        std::string host;
        std::string instance; // the component's name in that host
    };
    std::map<std::string, std::unique_ptr<rt::StepClient>> hosts_;
    std::vector<Step> steps_; // in the order of a tick
};

} // namespace tandem::wheelchair

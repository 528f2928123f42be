// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/run/run_directory.hpp"
#include "host/rt/step_client.hpp"

namespace tandem::wheelchair {

/// Lock-step: asks the hosts for one component's cycle after the other, in the order of the specification.
class LockstepDriver {
  public:
    /// Connects to the hosts of the run. Throws std::runtime_error.
    LockstepDriver(const RunDirectory& run, Configuration configuration);

    /// JoystickComp, ControlComp, and unless `last` HWComp. Throws std::runtime_error with the host's
    /// message.
    void run_tick(bool last);

  private:
    struct Step {
        rt::StepClient* host;
        std::string instance;
    };
    std::map<std::string, std::unique_ptr<rt::StepClient>> hosts_;
    std::vector<Step> steps_; // in order
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/body/core_wait.hpp"
#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"
#include "plugins/wheelchair/core/law/joystick_law.hpp"
#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// JoystickComp without a component model. Constructed at each activation and ticked every 10 ms.
class JoystickBody {
  public:
    /// `chair_limits`: result of limits() of service chair. Throws InputError (chair_limits_from()).
    JoystickBody(const Settings& settings, const std::vector<double>& chair_limits);

    void tick(JoystickPorts& ports); // [tick-thread]
    const JoystickParameters& parameters() const { return law_.parameters(); }

  private:
    Scenario scenario_;
    TickClock clock_;
    Trace<JoystickRecord> trace_;
    CoreWait core_wait_;
    JoystickLaw law_;
    Stamped<JoystickPosition> position_;
    SentTime position_sent_;
    double position_at_ = 0.0; // time at which it was sent
    int tick_ = 0;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"
#include "plugins/wheelchair/core/law/control_law.hpp"
#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// ControlComp without a component model: constructed at each activation, ticked every 10 ms.
class ControlBody {
  public:
    explicit ControlBody(const Settings& settings); // throws InputError

    void tick(ControlPorts& ports);       // [tick-thread]
    void deactivate(ControlPorts& ports); // sends 0 V and the brake flag, once

    ControlState state() const { return law_.state(); }

  private:
    /// Result of poll_reference(): how many references came, and when the newest was read.
    struct PollResult {
        int count;
        double at;
    };
    PollResult poll_reference(ControlPorts& ports);

    TickClock clock_;
    double poll_seconds_;
    Trace<ControlRecord> trace_;
    ControlLaw law_;
    Stamped<Reference> reference_;
    Stamped<WheelSpeed> wheels_;
    SentTime reference_sent_, wheels_sent_;
    double reference_at_ = 0.0, wheels_at_ = 0.0; // when they count as sent
    bool sender_restarted_ = false;               // sequence numbers began anew
    double first_tick_at_ = 0.0;
    int tick_ = 0;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/body/core_wait.hpp"
#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"
#include "plugins/wheelchair/core/law/control_law.hpp"
#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// ControlComp without a component model. Constructed at each activation and ticked every 10 ms.
class ControlBody {
  public:
    explicit ControlBody(const Settings& settings); // throws InputError

    void tick(ControlPorts& ports);       // [tick-thread]
    void deactivate(ControlPorts& ports); // sends 0 V and the brake flag once

    ControlState state() const { return law_.state(); }

  private:
    struct PollResult {
        int count;            // of received references
        double at;            // when the newest was read
        double longest_pause; // between two polls, see pause_between_polls()
    };
    PollResult poll_reference(ControlPorts& ports);

    TickClock clock_;
    double poll_seconds_;
    Trace<ControlRecord> trace_;
    CoreWait core_wait_;
    ControlLaw law_;
    Stamped<Reference> reference_;
    Stamped<WheelSpeed> wheels_;
    SentTime reference_sent_, wheels_sent_;
    double reference_at_ = 0.0, wheels_at_ = 0.0; // times at which they were sent
    bool sender_restarted_ = false;               // sequence numbers restarted
    double first_tick_at_ = 0.0;
    int tick_ = 0;
};

} // namespace tandem::wheelchair

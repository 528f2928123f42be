// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"
#include "plugins/wheelchair/core/plant/chair.hpp"
#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// HWComp without a component model. Constructed at each activation and ticked every 10 ms. Deactivation, stop and
/// error of the component call stop(), which needs no other component.
class HWBody {
  public:
    explicit HWBody(const Settings& settings); // throws InputError

    void publish(HWPorts& ports); // at activation: the values of t = 0
    void tick(HWPorts& ports);    // [tick-thread]
    void stop() { chair_.stop(); }

    /// Stops the motors in the next tick and keeps them stopped. [any-thread]
    void emergency_stop() { emergency_ = true; }

    const Chair& chair() const { return chair_; }

  private:
    HWRecord record(const Received<Voltage>& in, double applied_at) const;

    TickClock clock_;
    Trace<HWRecord> trace_;
    Chair chair_;
    Stamped<Voltage> voltage_;
    SentTime voltage_sent_;
    bool ticked_ = false, link_up_ = true;
    std::atomic<bool> emergency_{false};
};

/// Returns a record with the columns that describe the chair; the others are 0.
HWRecord make_record(const Chair& chair);

} // namespace tandem::wheelchair

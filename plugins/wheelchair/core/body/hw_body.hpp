// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"
#include "plugins/wheelchair/core/plant/chair.hpp"
#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// HWComp without its component model: made at activation, ticked every 10 ms. Whatever ends it
/// (deactivation, stop, error) calls stop(), which needs nobody else.
class HWBody {
  public:
    explicit HWBody(const Settings& settings); // throws InputError

    void publish(HWPorts& ports); // once at activation, t = 0
    void tick(HWPorts& ports);    // [tick-thread]
    void stop() { chair_.stop(); }

    /// Latches the emergency stop; acts in the next tick. [any-thread]
    void emergency_stop() { emergency_ = true; }

    const Chair& chair() const { return chair_; }

  private:
    HWRecord record(const Received<Voltage>& in, double applied_at) const;

    TickClock clock_;
    Trace<HWRecord> trace_;
    Chair chair_;
    Stamped<Voltage> voltage_;
    bool ticked_ = false, link_up_ = true;
    std::atomic<bool> emergency_{false};
};

/// The part of a record that describes the chair as it stands.
HWRecord make_record(const Chair& chair);

} // namespace tandem::wheelchair

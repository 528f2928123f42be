// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

class Plant; // not included, because Eigen takes longer to compile than a component

/// The simulated hardware: chair, motor drivers, encoders and an IO board with a safe stop (docs/wheelchair.md, section
/// 5.2). The safe stop needs no other component: without a voltage for 50 ms, after stop(), or without the link, both
/// voltages become 0 and the brake is set. Times are in s on the caller's clock. [one thread]
class Chair {
  public:
    /// Until the first voltage, the watchdog counts from `now`.
    Chair(const Scenario& scenario, double now);
    ~Chair();
    Chair(Chair&&) noexcept;
    /// Restarts the watchdog at `now`, because the first tick may come long after construction.
    void start_watchdog(double now) { last_voltage_ = now; }

    /// Performs the first half of a tick at time `now` [s]: applies the newest voltages, if any; then the watchdog, the safe
    /// stop if `forced_stop`, and the parking brake.
    void apply(double now, const std::optional<Stamped<Voltage>>& voltage, bool forced_stop);

    /// Performs the second half of a tick: simulates 10 ms and reads the encoders.
    void advance();

    /// Performs a safe stop: both voltages 0, brake set.
    void stop();

    int tick() const { return tick_; } // number of calls of advance()
    WheelSpeed wheel_speed() const;    // at tick(), from encoder counts
    JoystickPosition joystick() const; // at tick()
    Voltage applied() const { return {volts_left_, volts_right_, brake_}; }
    bool parking_brake() const { return hold_; } // closed
    bool watchdog_acts() const { return watchdog_; }
    double largest_current() const { return largest_current_; }
    const Plant& plant() const { return *plant_; }

  private:
    double pwm(double volts) const;
    double counts(double wheel_angle) const;

    Scenario scenario_;
    std::unique_ptr<Plant> plant_;
    int tick_ = 0;
    double volts_left_ = 0.0, volts_right_ = 0.0;
    bool brake_ = true, hold_ = true, watchdog_ = false;
    double last_voltage_;
    double count_left_, count_right_;
    double speed_left_ = 0.0, speed_right_ = 0.0;
    double largest_current_ = 0.0;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/plant.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// The hardware side: chair, motor drivers, encoders and the IO board with its safe stop. The safe stop
/// depends on nothing outside: no voltage for 50 ms, stop() or a lost link set both voltages to 0 and the
/// brake.
class Chair {
  public:
    /// `now`: the watchdog counts from there until the first voltage comes.
    Chair(const Scenario& scenario, double now);
    void start_watchdog(double now) { last_voltage_ = now; }

    /// First half of a tick at time `now`: takes a new voltage if one came (stamp as sent), applies watchdog
    /// and, while `forced_stop`, safe stop; decides on the parking brake.
    void apply(double now, const std::optional<Stamped<Voltage>>& voltage, bool forced_stop);

    /// Second half: moves the chair on by one tick and reads the encoders.
    void advance();

    void stop();

    int tick() const { return tick_; }
    WheelSpeed wheel_speed() const;    // at tick(), from encoder counts
    JoystickPosition joystick() const; // at tick()
    Voltage applied() const { return {volts_left_, volts_right_, brake_}; }
    bool parking_brake() const { return hold_; }
    bool watchdog_acts() const { return watchdog_; }
    double largest_current() const { return largest_current_; }
    const Plant& plant() const { return plant_; }

  private:
    double pwm(double volts) const;
    double counts(double wheel_angle) const;

    Scenario scenario_;
    Plant plant_;
    int tick_ = 0;
    double volts_left_ = 0.0, volts_right_ = 0.0;
    bool brake_ = true, hold_ = true, watchdog_ = false;
    double last_voltage_;
    double count_left_, count_right_;
    double speed_left_ = 0.0, speed_right_ = 0.0;
    double largest_current_ = 0.0;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/plant/chair.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/wheelchair/core/plant/numeric.hpp"
#include "plugins/wheelchair/core/plant/plant.hpp"

namespace tandem::wheelchair {

Chair::Chair(const Scenario& scenario, double now)
    : scenario_(scenario), plant_(std::make_unique<Plant>(PlantParameters{}, scenario.weak_left,
                                                          scenario.weak_right, scenario.slope)),
      last_voltage_(now) {
    plant_->state[index::caster_left] = scenario.caster_left_deg / degrees;
    plant_->state[index::caster_right] = scenario.caster_right_deg / degrees;
    count_left_ = counts(plant_->state[index::wheel_left]);
    count_right_ = counts(plant_->state[index::wheel_right]);
}

Chair::~Chair() = default;
Chair::Chair(Chair&&) noexcept = default;

// The motor driver has 2048 duty cycle steps in each direction.
double Chair::pwm(double volts) const {
    const PlantParameters& p = plant_->parameters();
    const double duty = limit(volts / p.bus_voltage, -p.max_duty, p.max_duty);
    return std::floor(duty * p.pwm_steps + 0.5) / p.pwm_steps * p.bus_voltage;
}

// The encoder at the motor shaft counts whole steps.
double Chair::counts(double wheel_angle) const {
    return std::floor(wheel_angle * (plant_->parameters().counts_per_turn / two_pi));
}

void Chair::stop() {
    volts_left_ = volts_right_ = 0.0;
    brake_ = true;
}

void Chair::apply(double now, const std::optional<Stamped<Voltage>>& voltage, bool forced_stop) {
    if (voltage && std::isfinite(voltage->stamp)) {
        last_voltage_ = std::min(voltage->stamp, now); // a future stamp would disable the watchdog
        volts_left_ = pwm(voltage->value.left);
        volts_right_ = pwm(voltage->value.right);
        brake_ = voltage->value.brake;
        // std::floor and limit() return NaN for NaN, which must not reach the motors.
        if (!std::isfinite(volts_left_) || !std::isfinite(volts_right_)) stop();
    }
    watchdog_ = now - last_voltage_ > stale_seconds + age_tolerance;
    if (watchdog_ || forced_stop) stop();
    if (!brake_) {
        hold_ = false;
    } else if (std::max(std::abs(speed_left_), std::abs(speed_right_)) < plant_->parameters().hold_speed) {
        hold_ = true; // stays true while the brake flag is set, even on a slope
    }
}

void Chair::advance() {
    const PlantParameters& p = plant_->parameters();
    plant_->integrate(tick_ * tick_seconds, tick_seconds,
                      {volts_left_, volts_right_, brake_ ? p.brake_current : p.max_current, hold_});
    largest_current_ = std::max({largest_current_, std::abs(plant_->state[index::current_left]),
                                 std::abs(plant_->state[index::current_right])});
    ++tick_;
    const double left = counts(plant_->state[index::wheel_left]);
    const double right = counts(plant_->state[index::wheel_right]);
    // Speed from whole counts per tick, as from a real encoder (docs/wheelchair.md, section 5.2).
    const double speed_per_count = two_pi / p.counts_per_turn / tick_seconds;
    speed_left_ = (left - count_left_) * speed_per_count;
    speed_right_ = (right - count_right_) * speed_per_count;
    count_left_ = left;
    count_right_ = right;
}

WheelSpeed Chair::wheel_speed() const {
    return {speed_left_, speed_right_, joystick().emergency_stop, count_left_, count_right_};
}

JoystickPosition Chair::joystick() const { return scenario_.stick_at(tick_); }

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/law/control_law.hpp"

#include <cmath>

#include "plugins/wheelchair/core/plant/numeric.hpp"

namespace tandem::wheelchair {

namespace {

bool is_stale(double t, double stamp) { return t - stamp > stale_seconds + age_tolerance; }

bool finite(const Reference& r, const WheelSpeed& w) {
    return std::isfinite(r.direction_deg) && std::isfinite(r.speed) && std::isfinite(w.left) &&
           std::isfinite(w.right);
}

/// Returns the output of a PI controller with feed-forward, limited to +-max. Uses the integral before updating it.
/// Does not update it while the output is limited and the error would drive it further into the limit (anti-windup).
double proportional_integral(double setpoint, double error, double feed_forward, double gain,
                             double integral_gain, double max, double& integral) {
    const double unlimited = feed_forward * setpoint + gain * error + integral;
    const double output = limit(unlimited, -max, max);
    if (output == unlimited || (unlimited - output) * error < 0.0)
        integral += integral_gain * tick_seconds * error;
    return output;
}

} // namespace

void ControlLaw::reset_integrators() { mean_integral_ = ratio_integral_ = 0.0; }

// Only a released stick ends `stale`, so that the chair does not start by itself when references return.
void ControlLaw::update_state(double t, const Stamped<Reference>& reference,
                              const Stamped<WheelSpeed>& wheels) {
    const bool late = is_stale(t, reference.stamp);
    if (wheels.value.emergency_stop) {
        state_ = ControlState::emergency_stop;
    } else if (!finite(reference.value, wheels.value) || is_stale(t, wheels.stamp)) {
        if (state_ != ControlState::emergency_stop) state_ = ControlState::fault;
    } else if (state_ == ControlState::run && late) {
        state_ = ControlState::stale;
    } else if (state_ == ControlState::stale && !late && reference.value.speed == 0.0 && speed_ == 0.0) {
        state_ = ControlState::run;
    }
}

/// Returns the reference; if it is stale, its last direction with a speed that decreases to 0.
Reference ControlLaw::effective_reference(const Reference& reference) {
    if (state_ == ControlState::stale) {
        const double max_change = parameters_.stop_deceleration * tick_seconds;
        speed_ -= limit(speed_, -max_change, max_change);
        return {last_direction_, speed_};
    }
    speed_ = reference.speed;
    last_direction_ = reference.direction_deg;
    return reference;
}

/// Counts the ticks of standstill, during which the integrators leak. Returns true when the brake must be set.
bool ControlLaw::update_standstill(double mean, double difference) {
    const ControlParameters& p = parameters_;
    if (speed_ == 0.0 && std::abs(mean) < p.still_speed && std::abs(difference) < p.still_speed) {
        ++still_tick_count_;
        mean_integral_ *= p.leak;
        ratio_integral_ *= p.leak;
    } else {
        still_tick_count_ = 0;
    }
    return still_tick_count_ >= p.still_ticks;
}

Voltage ControlLaw::drive(const Reference& reference, double mean, double difference) {
    const ControlParameters& p = parameters_;
    const double direction = reference.direction_deg, v = reference.speed;
    double mean_setpoint = 0.0, difference_setpoint = 0.0;
    if (std::abs(direction) >= spin_direction_deg) {
        filtered_direction_ = direction;
        difference_setpoint = (direction > 0 ? p.kappa : -p.kappa) * v / p.wheel_radius;
    } else {
        if (std::abs(filtered_direction_) >= spin_direction_deg) filtered_direction_ = 0.0;
        filtered_direction_ += p.direction_filter * (direction - filtered_direction_);
        const double k = p.kappa * std::tan(filtered_direction_ / degrees);
        mean_setpoint = v / p.wheel_radius;
        // At standstill the ratio is undefined, so the requested mean speed replaces the measured one. Between
        // standstill and blend_speed, both are blended.
        double blend = 1.0 - std::abs(mean) / p.blend_speed;
        if (blend < 0.0) blend = 0.0;
        difference_setpoint = k * (mean + blend * (mean_setpoint - mean));
    }
    const double ratio_error = difference_setpoint - difference;
    const double speed_error = mean_setpoint - mean;
    const double ud = proportional_integral(difference_setpoint, ratio_error, p.feed_forward, p.ratio_gain,
                                            p.ratio_integral, p.max_difference, ratio_integral_);
    const double um = proportional_integral(mean_setpoint, speed_error, p.feed_forward, p.speed_gain,
                                            p.speed_integral, p.max_voltage - std::abs(ud), mean_integral_);
    return {um - ud, um + ud, false};
}

Voltage ControlLaw::tick(double t, const Stamped<Reference>& reference, const Stamped<WheelSpeed>& wheels) {
    constexpr Voltage stop{0.0, 0.0, true};
    update_state(t, reference, wheels);
    if (state_ == ControlState::emergency_stop || state_ == ControlState::fault) {
        reset_integrators();
        speed_ = 0.0;
        return stop;
    }
    const Reference target = effective_reference(reference.value);
    const double mean = 0.5 * (wheels.value.right + wheels.value.left);
    const double difference = 0.5 * (wheels.value.right - wheels.value.left);
    if (update_standstill(mean, difference)) {
        reset_integrators();
        filtered_direction_ = target.direction_deg;
        return stop;
    }
    return drive(target, mean, difference);
}

} // namespace tandem::wheelchair

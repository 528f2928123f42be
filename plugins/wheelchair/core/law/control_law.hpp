// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// run: the law. stale: reference older than 50 ms, slow down in the kept direction. emergency_stop and fault
/// (a number not finite, or wheel speed older than 50 ms): no voltage and brake, until a new ControlLaw.
enum class ControlState { run = 0, stale = 1, emergency_stop = 2, fault = 3 };

/// Speed-ratio control of two drive wheels: the difference voltage, which holds the ratio of the wheel speeds
/// and so the curve, comes first; the mean voltage gets what is left, so the chair slows down rather than
/// runs wide.
class ControlLaw {
  public:
    explicit ControlLaw(const ControlParameters& parameters = {}) : parameters_(parameters) {}

    /// One 10 ms tick at time `t` [s]; stamps are on the same clock.
    Voltage tick(double t, const Stamped<Reference>& reference, const Stamped<WheelSpeed>& wheels);

    ControlState state() const { return state_; }
    double filtered_direction_deg() const { return filtered_direction_; }

  private:
    void update_state(double t, const Stamped<Reference>& reference, const Stamped<WheelSpeed>& wheels);
    Reference effective_reference(const Reference& reference);
    bool update_standstill(double mean, double difference);
    Voltage drive(const Reference& reference, double mean, double difference);
    void reset_integrators();

    ControlParameters parameters_;
    ControlState state_ = ControlState::run;
    double filtered_direction_ = 0.0, last_direction_ = 0.0, speed_ = 0.0;
    double mean_integral_ = 0.0, ratio_integral_ = 0.0; // V
    int still_tick_count_ = 0;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// The safety states of docs/wheelchair.md, section 6.5. stale: the reference is older than 50 ms; the chair slows down
/// in its last direction. fault: a number is not finite, or the wheel speed is older than 50 ms. emergency_stop and
/// fault set 0 V and the brake, and last as long as the ControlLaw object.
enum class ControlState { run = 0, stale = 1, emergency_stop = 2, fault = 3 };

/// Speed-ratio control of two drive wheels (docs/wheelchair.md, section 6). The voltage difference controls the ratio
/// of the wheel speeds, and so the curve; it is therefore limited first; the mean voltage gets the rest. If the
/// voltage is insufficient, the chair slows down but stays on its curve.
class ControlLaw {
  public:
    explicit ControlLaw(const ControlParameters& parameters = {}) : parameters_(parameters) {}

    /// Returns the voltages for the 10 ms from time `t` [s]. The stamps use the same clock.
    Voltage tick(double t, const Stamped<Reference>& reference, const Stamped<WheelSpeed>& wheels);

    ControlState state() const { return state_; }
    double filtered_direction_deg() const { return filtered_direction_; }

  private:
    void update_state(double t, const Stamped<Reference>& reference, const Stamped<WheelSpeed>& wheels);
    // Returns the reference, or the path to a stop if the reference is stale.
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

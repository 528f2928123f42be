// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// Converts stick positions to a reference direction and speed (docs/wheelchair.md, section 5.3): dead zone, driving or
/// turning on the spot, limits of lateral acceleration and of rates. Not thread-safe.
class JoystickLaw {
  public:
    explicit JoystickLaw(const JoystickParameters& parameters = {}) : parameters_(parameters) {}

    /// Returns the reference for this 10 ms tick.
    Reference tick(const JoystickPosition& stick);
    const JoystickParameters& parameters() const { return parameters_; }

  private:
    /// The stick's request before the rate limits.
    struct Target {
        double direction, speed;
        bool neutral, spin; // neutral: stick released; spin: turning on the spot
    };
    Target target(const JoystickPosition& stick) const;
    void change_mode(Target& target);
    void limit_speed(double requested);
    void limit_direction(double requested);

    JoystickParameters parameters_;
    double direction_ = 0.0, speed_ = 0.0;
    bool spin_ = false;
};

} // namespace tandem::wheelchair

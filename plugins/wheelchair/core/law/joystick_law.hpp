// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// Turns stick positions into a reference direction and speed: dead zone, driving or turning on the spot,
/// lateral acceleration limit, rate limits. One call per 10 ms tick.
class JoystickLaw {
  public:
    explicit JoystickLaw(const JoystickParameters& parameters = {}) : parameters_(parameters) {}

    Reference tick(const JoystickPosition& stick);
    const JoystickParameters& parameters() const { return parameters_; }

  private:
    struct Target {
        double direction, speed;
        bool neutral, spin;
    };
    Target target(const JoystickPosition& stick) const;
    void change_mode(Target& target);
    void limit_speed(double wanted);
    void limit_direction(double wanted);

    JoystickParameters parameters_;
    double direction_ = 0.0, speed_ = 0.0;
    bool spin_ = false;
};

} // namespace tandem::wheelchair

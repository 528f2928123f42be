// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/law/joystick_law.hpp"

#include <cmath>

#include "plugins/wheelchair/core/plant/numeric.hpp"

namespace tandem::wheelchair {

JoystickLaw::Target JoystickLaw::target(const JoystickPosition& stick) const {
    const JoystickParameters& p = parameters_;
    const double span = p.max_count - p.dead_zone;
    const double ax = limit(std::abs(stick.x), 0.0, p.max_count) - p.dead_zone;
    const double ay = limit(std::abs(stick.y), 0.0, p.max_count) - p.dead_zone;
    const double side = stick.x < 0 ? -1.0 : 1.0;
    const double way = stick.y < 0 ? -1.0 : 1.0;
    const bool neutral = ax <= 0 && ay <= 0;
    const bool spin = ax > 0 && ay <= 0;
    if (neutral || stick.emergency_stop) return {direction_, 0.0, neutral, spin};
    if (spin) return {side * 90.0, ax * p.max_spin / span, neutral, spin};

    const double direction = ax > 0 ? side * (ax * p.max_direction_deg / span) : 0.0;
    double speed = way * (ay * (way > 0 ? p.max_forward : p.max_reverse) / span);
    // Lateral acceleration is v^2 tan(direction) / wheelbase.
    const double tangent = std::abs(std::tan(direction / degrees));
    if (speed * speed * tangent > p.lateral_acceleration * p.wheelbase)
        speed = way * std::sqrt(p.lateral_acceleration * p.wheelbase / tangent);
    return {direction, speed, neutral, spin};
}

// To change between driving and turning on the spot, or the side of a spin, first reduces the speed to 0.
void JoystickLaw::change_mode(Target& target) {
    if (target.neutral) {
        if (speed_ == 0.0) {
            spin_ = false;
            direction_ = target.direction = 0.0;
        }
        return;
    }
    const bool change = target.spin != spin_ || (target.spin && direction_ * target.direction < 0.0);
    if (change && speed_ != 0.0) {
        target.speed = 0.0;
        target.direction = direction_;
    } else if (change) {
        spin_ = target.spin;
        direction_ = target.spin ? target.direction : 0.0;
    }
}

void JoystickLaw::limit_speed(double requested) {
    double change = requested - speed_;
    if (requested * speed_ < 0.0) change = -speed_; // a reversal stops at zero first
    const bool faster = std::abs(speed_ + change) > std::abs(speed_);
    const double max_change = (faster ? parameters_.acceleration : parameters_.deceleration) * tick_seconds;
    speed_ += std::abs(change) > max_change ? limit(change, -max_change, max_change) : change;
}

void JoystickLaw::limit_direction(double requested) {
    if (parameters_.direction_rate > 0.0 && !spin_) {
        const double max_change = parameters_.direction_rate * tick_seconds;
        const double change = requested - direction_;
        direction_ =
            std::abs(change) > max_change ? direction_ + limit(change, -max_change, max_change) : requested;
    } else {
        direction_ = requested;
    }
}

Reference JoystickLaw::tick(const JoystickPosition& stick) {
    Target requested = target(stick);
    change_mode(requested);
    limit_speed(requested.speed);
    limit_direction(requested.direction);
    return {direction_, speed_};
}

} // namespace tandem::wheelchair

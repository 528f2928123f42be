// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/body/joystick_body.hpp"

#include "plugins/wheelchair/core/law/limits.hpp"

namespace tandem::wheelchair {

namespace {

JoystickParameters joystick_parameters(const Scenario& scenario, const std::vector<double>& chair_limits) {
    JoystickParameters p;
    const ChairLimits limits = chair_limits_from(chair_limits);
    p.max_forward = limits.forward;
    p.max_reverse = limits.reverse;
    p.max_spin = limits.spin;
    p.lateral_acceleration = limits.lateral_acceleration;
    p.direction_rate = scenario.direction_rate;
    return p;
}

} // namespace

JoystickBody::JoystickBody(const Settings& settings, const std::vector<double>& chair_limits)
    : scenario_(settings.scenario), clock_(settings.clock), trace_(settings.trace),
      law_(joystick_parameters(settings.scenario, chair_limits)), position_sent_(settings.clock) {}

void JoystickBody::tick(JoystickPorts& ports) {
    const auto in = ports.positions();
    if (in.newest) {
        position_ = *in.newest;
        position_at_ = position_sent_.of(position_.stamp, clock_.at(tick_));
    }
    const Reference reference = law_.tick(position_.value);
    // A reference gets a new stamp, which would hide the age of an old stick position: after a pause of this process,
    // the driver may have released the stick long ago. Without a reference, ControlComp stops the chair.
    const bool position_is_stale = clock_.at(tick_) - position_at_ > stale_seconds + 1e-9;
    // The mute window is in scenario time, which counts HWComp's ticks.
    const bool sent = !position_is_stale && !scenario_.muted(position_.sequence * tick_seconds);
    const Stamped<Reference> out{clock_.at(tick_), static_cast<double>(tick_), reference};
    if (sent) ports.send(out);
    trace_.append({monotonic_seconds(), out.sequence, position_.sequence, static_cast<double>(in.count),
                   position_.value.x, position_.value.y, position_.value.emergency_stop ? 1.0 : 0.0,
                   reference.direction_deg, reference.speed, sent ? 1.0 : 0.0, out.stamp,
                   core_wait_.seconds_since_last_call()});
    ++tick_;
}

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/body/hw_body.hpp"

#include "plugins/wheelchair/core/plant/plant.hpp"

namespace tandem::wheelchair {

HWRecord make_record(const Chair& chair) {
    const State& s = chair.plant().state;
    const auto stick = chair.joystick();
    const auto wheels = chair.wheel_speed();
    const auto applied = chair.applied();
    HWRecord r{};
    r.sequence = chair.tick();
    r.volts_left = applied.left;
    r.volts_right = applied.right;
    r.brake = applied.brake;
    r.parking_brake = chair.parking_brake();
    r.watchdog = chair.watchdog_acts();
    r.jx = stick.x;
    r.jy = stick.y;
    r.emergency_stop = stick.emergency_stop;
    r.wheel_left_measured = wheels.left;
    r.wheel_right_measured = wheels.right;
    r.wheel_left = chair.plant().wheel_speed_left();
    r.wheel_right = chair.plant().wheel_speed_right();
    r.current_left = s[index::current_left];
    r.current_right = s[index::current_right];
    r.x = s[index::x];
    r.y = s[index::y];
    r.heading = s[index::heading];
    r.caster_left = s[index::caster_left];
    r.caster_right = s[index::caster_right];
    return r;
}

HWBody::HWBody(const Settings& settings)
    : clock_(settings.clock), trace_(settings.trace), chair_(settings.scenario, 0.0),
      voltage_sent_(settings.clock) {}

HWRecord HWBody::record(const Received<Voltage>& in, double applied_at) const {
    HWRecord r = make_record(chair_);
    r.at = monotonic_seconds();
    r.applied_at = applied_at;
    r.voltage_sequence = voltage_.sequence;
    r.voltage_stamp = voltage_.stamp;
    r.voltages_received = in.count;
    r.link_up = link_up_;
    if (emergency_) r.emergency_stop = 1.0;
    return r;
}

// tick() appends the record of a tick. Only the record of t = 0 is appended here.
void HWBody::publish(HWPorts& ports) {
    auto position = chair_.joystick();
    auto wheels = chair_.wheel_speed();
    if (emergency_) position.emergency_stop = wheels.emergency_stop = true;
    const double stamp = clock_.at(chair_.tick()), sequence = chair_.tick();
    // Recorded before sending, because merge() assumes that records of receivers are later than that of the
    // publication.
    if (chair_.tick() == 0) trace_.append(record({}, monotonic_seconds()));
    ports.send({stamp, sequence, position}, {stamp, sequence, wheels});
}

void HWBody::tick(HWPorts& ports) {
    const auto in = ports.voltages();
    if (const auto link = ports.link_states(); link.newest) link_up_ = link.newest->value.up;
    const double now = clock_.at(chair_.tick());
    if (!ticked_) chair_.start_watchdog(now); // activation may have been long ago
    ticked_ = true;
    if (in.newest) voltage_ = *in.newest;
    // A lost link stops the chair at once, without waiting for the watchdog.
    auto voltage = in.newest;
    if (voltage) voltage->stamp = voltage_sent_.of(voltage->stamp, now);
    chair_.apply(now, voltage, !link_up_ || emergency_);
    const double applied_at = monotonic_seconds();
    chair_.advance();
    trace_.append(record(in, applied_at));
    publish(ports);
}

} // namespace tandem::wheelchair

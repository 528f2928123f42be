// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/body/control_body.hpp"

#include <algorithm>
#include <utility>

namespace tandem::wheelchair {

namespace {

ControlParameters control_parameters(const Settings& settings) {
    ControlParameters parameters;
    parameters.ratio_gain = settings.ratio_gain;
    return parameters;
}

/// Waits between two polls of the port. Without a pause, a sender would almost always find the port's lock taken by this
/// poller. Returns the longest time between two readings of the clock [s]: it is long only if the core was taken away,
/// by another thread, an interrupt or the hypervisor.
double pause_between_polls() {
    constexpr double pause_seconds = 3e-7;
    double now = monotonic_seconds(), longest = 0.0;
    for (const double end = now + pause_seconds; now < end;) {
        const double before = std::exchange(now, monotonic_seconds());
        longest = std::max(longest, now - before);
    }
    return longest;
}

} // namespace

ControlBody::ControlBody(const Settings& settings)
    : clock_(settings.clock), poll_seconds_(settings.poll_seconds), trace_(settings.trace),
      law_(control_parameters(settings)), reference_sent_(settings.clock), wheels_sent_(settings.clock) {}

/// Polls for this tick's reference, at most for poll_us. All components tick on one grid in real time, so the reference
/// is read as soon as it is visible, and the trace measures the transport instead of the phase between two timers. A
/// reference from the previous tick does not end the polling, because ControlComp would then remain one tick behind.
ControlBody::PollResult ControlBody::poll_reference(ControlPorts& ports) {
    // Real time even in simulation, because this is the time of polling. In lock-step, poll_us is 0.
    const double give_up = monotonic_seconds() + poll_seconds_;
    PollResult poll{0, monotonic_seconds(), 0.0};
    for (;;) {
        const auto in = ports.references();
        const double now = monotonic_seconds();
        if (in.newest) {
            sender_restarted_ = sender_restarted_ || in.newest->sequence < reference_.sequence;
            reference_ = *in.newest;
            reference_at_ = reference_sent_.of(reference_.stamp, clock_.at(tick_));
            poll.count += in.count;
            poll.at = now;
        }
        // Uses the stamp instead of the sequence number, which a restarted JoystickComp resets.
        const bool of_this_tick = in.newest && now - reference_at_ < 0.5 * tick_seconds;
        if (of_this_tick || now >= give_up) return poll;
        poll.longest_pause = std::max(poll.longest_pause, pause_between_polls());
    }
}

void ControlBody::tick(ControlPorts& ports) {
    const PollResult poll = poll_reference(ports);
    if (const auto in = ports.wheels(); in.newest) {
        wheels_ = *in.newest;
        wheels_at_ = wheels_sent_.of(wheels_.stamp, clock_.at(tick_));
    }
    const double t = clock_.at(tick_);
    // A message from before the first tick is not late, because this component could not have read it.
    if (tick_ == 0) first_tick_at_ = t;
    const auto bounded = [&](auto message, double sent_at) {
        message.stamp = std::min(std::max(sent_at, first_tick_at_), t);
        return message;
    };
    auto reference = bounded(reference_, reference_at_);
    // A restarted JoystickComp starts at speed 0, and following it would stop the chair abruptly. Its first reference
    // is treated as stale, so the chair slows down and drives again after the stick was released.
    if (std::exchange(sender_restarted_, false)) reference.stamp = t - 2.0 * stale_seconds;
    const Voltage voltage = law_.tick(t, reference, bounded(wheels_, wheels_at_));
    ports.send({t, static_cast<double>(tick_), voltage});
    trace_.append({monotonic_seconds(), static_cast<double>(tick_), t, reference_.sequence, reference_.stamp,
                   poll.at, static_cast<double>(poll.count), wheels_.sequence, wheels_.stamp,
                   law_.filtered_direction_deg(), static_cast<double>(law_.state()), voltage.left,
                   voltage.right, voltage.brake ? 1.0 : 0.0,
                   // In this order, a NaN of the kernel's count leaves the pause.
                   std::max(poll.longest_pause, core_wait_.seconds_since_last_call())});
    ++tick_;
}

void ControlBody::deactivate(ControlPorts& ports) {
    ports.send({clock_.at(tick_), static_cast<double>(tick_), Voltage{0.0, 0.0, true}});
}

} // namespace tandem::wheelchair

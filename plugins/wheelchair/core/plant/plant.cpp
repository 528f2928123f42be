// SPDX-License-Identifier: Apache-2.0
// The equations of docs/wheelchair.md, section 4. The order of floating-point operations is part of the model. Do not
// regroup terms: every build and the Python reference must agree to the last encoder count.
#include "plugins/wheelchair/core/plant/plant.hpp"

#include <cmath>

#include "plugins/wheelchair/core/plant/numeric.hpp"

namespace tandem::wheelchair {

namespace {

constexpr double step_seconds = 0.001; // of the integrator; section 12 describes the loss of accuracy

/// Result of drive().
struct Drive {
    double current_rate; // A/s
    double torque;       // N m at the wheel
};

/// Computes one motor with driver, gear, wheel and brake. `wheel`: the wheel's speed [rad/s]; `k`: motor constant at
/// the wheel; `load`: force on the ground [N].
Drive drive(const PlantParameters& p, double volts, double current, double wheel, double k, double load,
            const PlantInput& in) {
    const double back_emf = k * wheel;
    // The driver limits the current by limiting the voltage across the armature's resistance.
    const double room = p.resistance * in.current_limit;
    const double applied = limit(volts, back_emf - room, back_emf + room);
    const double scale2 = p.current_scale * p.current_scale;
    const double loss = p.constant_loss + p.gear_loss * k * std::sqrt(current * current + scale2) +
                        p.drive_rolling * load * p.wheel_radius;
    double torque = k * current - loss * smooth_sign(wheel, p.wheel_scale);
    if (in.parking_brake) torque -= p.brake_torque * smooth_sign(wheel, p.brake_scale);
    return {(applied - back_emf - p.resistance * current) / p.inductance, torque};
}

/// Result of caster().
struct Caster {
    double force_x;  // N on the chassis, forward
    double yaw;      // N m on the chassis
    double steering; // N m about the pivot, without the chassis' own yaw acceleration
};

/// Computes the forces of a caster. `side`: its pivot's distance to the left of the centre line [m]; `angle`, `rate`:
/// of the caster relative to the chair; `v`, `w`: speed and yaw rate of the chair; `load`: force on the ground [N].
Caster caster(const PlantParameters& p, double side, double angle, double rate, double v, double w,
              double load) {
    const double c = std::cos(angle), q = std::sin(angle);
    const double vx = v - w * side;
    const double vy = w * p.wheelbase;
    const double along = vx * c + vy * q;
    const double across = -vx * q + vy * c - p.caster_trail * (w + rate);
    const double lateral = -p.caster_side_friction * load * smooth_sign(across, p.side_slip_scale);
    const double rolling = -p.caster_rolling * load * smooth_sign(along, p.roll_scale);
    const double fx = rolling * c - lateral * q;
    const double fy = rolling * q + lateral * c;
    const double bearing = p.bearing_friction * smooth_sign(rate, p.bearing_scale);
    const double scrub = p.caster_scrub * smooth_sign(w + rate, p.caster_scrub_scale);
    return {fx, p.wheelbase * fy - side * fx + bearing, -p.caster_trail * lateral - bearing - scrub};
}

} // namespace

double Slope::angle_at(double t) const {
    if (!present) return 0.0;
    return angle_deg / degrees * limit((t - start) / duration, 0.0, 1.0);
}

Plant::Plant(const PlantParameters& parameters, double weak_left, double weak_right, const Slope& slope)
    : parameters_(parameters), drive_left_(parameters.gear_ratio * parameters.motor_constant * weak_left),
      drive_right_(parameters.gear_ratio * parameters.motor_constant * weak_right), slope_(slope),
      uphill_(slope.uphill_heading_deg / degrees) {}

double Plant::wheel_speed_left() const {
    return (state[index::speed] - 0.5 * parameters_.track * state[index::yaw_rate]) /
           parameters_.wheel_radius;
}

double Plant::wheel_speed_right() const {
    return (state[index::speed] + 0.5 * parameters_.track * state[index::yaw_rate]) /
           parameters_.wheel_radius;
}

State Plant::derivative(const State& s, const PlantInput& in, double slope) const {
    const PlantParameters& p = parameters_;
    const double th = s[index::heading], v = s[index::speed], w = s[index::yaw_rate];
    const double half_track = 0.5 * p.track;
    const double wl = (v - half_track * w) / p.wheel_radius;
    const double wr = (v + half_track * w) / p.wheel_radius;
    const double cb = std::cos(slope), sb = std::sin(slope);
    const double drive_load = p.mass * p.gravity * cb * (1.0 - p.mass_centre / p.wheelbase) * 0.5;
    const double caster_load = p.mass * p.gravity * cb * (p.mass_centre / p.wheelbase) * 0.5;
    const Drive left = drive(p, in.volts_left, s[index::current_left], wl, drive_left_, drive_load, in);
    const Drive right = drive(p, in.volts_right, s[index::current_right], wr, drive_right_, drive_load, in);

    // Gravity on the slope, in the chair's axes.
    const double gx = -p.mass * p.gravity * sb * std::cos(uphill_ - th);
    const double gy = -p.mass * p.gravity * sb * std::sin(uphill_ - th);
    double force = gx;
    double moment = p.mass_centre * gy - p.drive_scrub * smooth_sign(w, p.drive_scrub_scale);
    const Caster cl =
        caster(p, p.caster_offset, s[index::caster_left], s[index::caster_left_rate], v, w, caster_load);
    force += cl.force_x;
    moment += cl.yaw;
    const Caster cr =
        caster(p, -p.caster_offset, s[index::caster_right], s[index::caster_right_rate], v, w, caster_load);
    force += cr.force_x;
    moment += cr.yaw;

    // The wheels' inertia moves with the chair, so it adds to mass and yaw inertia.
    const double r = p.wheel_radius;
    const double mass = p.mass + 2.0 * p.wheel_inertia / (r * r);
    const double inertia = p.yaw_inertia + p.mass * p.mass_centre * p.mass_centre +
                           p.track * p.track * p.wheel_inertia / (2.0 * r * r);
    const double dv = ((right.torque + left.torque) / r + p.mass * p.mass_centre * w * w + force) / mass;
    const double dw =
        (half_track / r * (right.torque - left.torque) - p.mass * p.mass_centre * v * w + moment) / inertia;

    State d;
    d << v * std::cos(th), v * std::sin(th), w, dv, dw, left.current_rate, right.current_rate,
        s[index::caster_left_rate], cl.steering / p.caster_inertia - dw, s[index::caster_right_rate],
        cr.steering / p.caster_inertia - dw, wl, wr;
    return d;
}

// Classical fourth-order Runge-Kutta. The slope is evaluated at the stage times.
void Plant::step(double t, double h, const PlantInput& input) {
    const double middle = slope_.angle_at(t + 0.5 * h);
    const State k1 = derivative(state, input, slope_.angle_at(t));
    const State k2 = derivative(state + (0.5 * h) * k1, input, middle);
    const State k3 = derivative(state + (0.5 * h) * k2, input, middle);
    const State k4 = derivative(state + h * k3, input, slope_.angle_at(t + h));
    state = (state + (h / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4)).eval();
}

void Plant::integrate(double t, double seconds, const PlantInput& input) {
    // 1e-9: 0.01 / 0.001 is slightly below 10.
    const int steps = static_cast<int>(std::floor(seconds / step_seconds + 1e-9));
    for (int j = 0; j < steps; ++j) step(t + j * step_seconds, step_seconds, input);
    const double rest = seconds - steps * step_seconds;
    if (rest > 1e-12) step(t + steps * step_seconds, rest, input);
}

} // namespace tandem::wheelchair

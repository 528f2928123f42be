// SPDX-License-Identifier: Apache-2.0
// The parameters of the simulated power wheelchair, in SI units unless a name contains deg; left is positive.
// docs/wheelchair.md, sections 3 (plant), 5.3 (joystick) and 6.2 (control), gives the reason for each value. None was
// measured on a real chair.
#pragma once

#include <numbers>

namespace tandem::wheelchair {

inline constexpr double tick_seconds = 0.010; // period of all three components
inline constexpr double two_pi = 2.0 * std::numbers::pi;
inline constexpr double degrees = 180.0 / std::numbers::pi; // degrees per radian

/// Parameters of the mechanical and electrical system.
struct PlantParameters {
    double gravity = 9.81;
    // geometry [m]
    double track = 0.57;        // drive wheel to drive wheel
    double wheelbase = 0.50;    // rear axle to caster pivots
    double mass_centre = 0.20;  // in front of the rear axle
    double wheel_radius = 0.17; // drive wheels
    double caster_offset = 0.24;
    double caster_trail = 0.06;
    // inertia
    double mass = 150.0;
    double yaw_inertia = 9.0;      // about the centre of mass
    double wheel_inertia = 0.51;   // a drive wheel with its rotor, at the wheel
    double caster_inertia = 0.030; // about the pivot
    // motor, gear, driver of one side
    double bus_voltage = 24.0;
    double max_duty = 0.95;
    double pwm_steps = 2048;
    double resistance = 0.40;
    double inductance = 1.0e-3;
    double motor_constant = 0.04625; // N m/A = V s/rad at the motor shaft
    double gear_ratio = 32.0;
    double gear_loss = 0.20;     // load-dependent
    double constant_loss = 1.9;  // N m at the wheel
    double max_current = 60.0;   // A
    double brake_current = 20.0; // A, limit while the brake flag is set
    double current_scale = 0.5;  // A, smoothing of |i|
    double wheel_scale = 0.10;   // rad/s, smoothing of the wheel friction
    // ground
    double drive_rolling = 0.015;
    double caster_rolling = 0.030;
    double caster_side_friction = 0.70;
    double side_slip_scale = 0.05;
    double roll_scale = 0.02;
    double drive_scrub = 4.0;
    double drive_scrub_scale = 0.05;
    double caster_scrub = 1.0;
    double caster_scrub_scale = 0.50;
    double bearing_friction = 0.30;
    double bearing_scale = 0.50;
    double brake_torque = 40.0; // parking brake, each wheel
    double brake_scale = 0.02;
    double hold_speed = 1.0; // rad/s, wheel speed below which the parking brake may close
    // encoder: 1000 lines, counted four times, on the motor shaft
    double counts_per_turn = 1000 * 4 * 32;
};

/// Parameters of JoystickComp.
struct JoystickParameters {
    double max_count = 2000; // of the stick, in each direction
    double dead_zone = 100;  // counts
    double max_direction_deg = 38.0;
    double max_forward = 1.9;      // m/s
    double max_reverse = 0.95;     // m/s
    double max_spin = 0.38;        // m/s of the point between the casters
    double acceleration = 0.8;     // m/s^2
    double deceleration = 1.2;     // m/s^2
    double direction_rate = 120.0; // deg/s; 0: not limited, as for the paper's electronic reference
    double lateral_acceleration = 1.2;
    double wheelbase = 0.50;
};

/// Parameters of ControlComp.
struct ControlParameters {
    double wheel_radius = 0.17;
    double kappa = 0.57 / (2.0 * 0.50); // track / (2 wheelbase)
    double max_voltage = 22.8;
    double max_difference = 12.0;     // V
    double feed_forward = 1.48;       // V s/rad at the wheel
    double direction_filter = 0.0625; // share of the difference per tick
    double speed_gain = 8.0;
    double speed_integral = 8.0;
    double ratio_gain = 16.0;
    double ratio_integral = 64.0;
    double stop_deceleration = 1.5; // m/s^2 on a stale reference
    double still_speed = 0.2;       // rad/s
    int still_ticks = 10;           // ticks of standstill before the brake is set
    double leak = 0.9;              // integrator factor per tick of standstill
    double blend_speed = 1.0;       // rad/s; below it, the ratio law blends in the reference
};

inline constexpr double stale_seconds = 0.050;     // maximum age of a message
inline constexpr double age_tolerance = 1e-9;      // simulated times are multiples of 0.01 up to rounding
inline constexpr double spin_direction_deg = 60.0; // from this direction on, the chair turns on the spot
inline constexpr double min_steering_speed = 0.2;  // rad/s; below it, the steering angle is undefined

} // namespace tandem::wheelchair

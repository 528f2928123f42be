// SPDX-License-Identifier: Apache-2.0
// The log of a run: one row per tick, in the CSV format of docs/wheelchair.md, section 11.
#pragma once

#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// The values of a tick after the cycles of JoystickComp and ControlComp and before HWComp's. Voltages are those sent
/// in this tick.
struct Row {
    double t = 0.0;
    long jx = 0, jy = 0;
    double reference_direction_deg = 0.0, reference_speed = 0.0, filtered_direction_deg = 0.0;
    double steering_measured_deg = 0.0, steering_true_deg = 0.0;
    double wheel_left_measured = 0.0, wheel_right_measured = 0.0, wheel_left = 0.0, wheel_right = 0.0;
    double volts_left = 0.0, volts_right = 0.0, current_left = 0.0, current_right = 0.0;
    double x = 0.0, y = 0.0, heading = 0.0, caster_left_deg = 0.0, caster_right_deg = 0.0;
    long brake = 0, state = 0;
};

/// Runs a scenario in simulated time, in this process and without components. In lock-step, every configuration must
/// reproduce these rows exactly.
std::vector<Row> simulate(const Scenario& scenario);

/// Returns rows 0 .. last_tick from the traces of the three components. A row contains a publication of HWComp, and the
/// values that JoystickComp and ControlComp computed from it, or their last values if they missed it. If HWComp was
/// started several times, uses its last start.
std::vector<Row> merge(const std::vector<HWRecord>& hw, const std::vector<JoystickRecord>& joystick,
                       const std::vector<ControlRecord>& control, int last_tick);

/// Returns a heading line and the rows: numbers as %.7g, magnitudes below 1e-12 as 0, counts and flags as whole
/// numbers.
std::string csv_text(const std::vector<Row>& rows);

} // namespace tandem::wheelchair

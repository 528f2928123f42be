// SPDX-License-Identifier: Apache-2.0
// The log of a run: one row per tick, in the CSV format of docs/wheelchair.md, section 11.
#pragma once

#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// The values of one tick after the cycles of JoystickComp and ControlComp and before HWComp's; the voltages
/// are those sent in this tick.
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

/// Runs a scenario in simulation time, in this process and without components. Every configuration must
/// reproduce these rows in lock-step, byte for byte.
std::vector<Row> simulate(const Scenario& scenario);

/// Rows 0 .. last_tick from the traces of the three components. A row has one publication of HWComp, and the
/// values that JoystickComp and ControlComp computed from it; if one of them missed it, that component's last
/// values. If HWComp was started more than once, the rows are those of its last start.
std::vector<Row> merge(const std::vector<HWRecord>& hw, const std::vector<JoystickRecord>& joystick,
                       const std::vector<ControlRecord>& control, int last_tick);

/// A heading line and the rows: numbers as %.7g, magnitudes below 1e-12 as 0, counts and flags as whole
/// numbers.
std::string csv_text(const std::vector<Row>& rows);

/// Writes csv_text() to a file. Throws InputError when that fails.
void write_csv(const std::string& path, const std::vector<Row>& rows);

} // namespace tandem::wheelchair

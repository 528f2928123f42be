// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/plant.hpp"

namespace tandem::wheelchair {

/// Bad input to the run: what() is one line that names file, place and remedy.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One test drive: what the user does with the stick, and what is special about chair and ground.
struct Scenario {
    std::string name;
    double seconds = 0.0;
    std::function<JoystickPosition(int tick)> stick; // without emergency stop, see emergency_stop_at
    double direction_rate = JoystickParameters{}.direction_rate;
    double weak_left = 1.0, weak_right = 1.0;
    double caster_left_deg = 0.0, caster_right_deg = 0.0;
    Slope slope;
    double emergency_stop_at = 1e9;           // s
    std::pair<double, double> mute{1e9, 1e9}; // JoystickComp sends nothing in [first, second) s

    int last_tick() const;                     // number of HWComp ticks of the whole drive
    JoystickPosition stick_at(int tick) const; // with emergency stop
    bool muted(double t) const;
};

/// The named scenarios, in the order of the specification; `recorded` (nothing special, stick from a file)
/// last.
const std::vector<Scenario>& scenarios();

/// Throws InputError that lists the names when there is none such.
const Scenario& find_scenario(const std::string& name);

/// Scenario `name` (empty: `recorded` with a file, `step20` without), its stick replaced by `joystick_file`
/// unless that is empty.
Scenario load_scenario(const std::string& name, const std::string& joystick_file);

} // namespace tandem::wheelchair

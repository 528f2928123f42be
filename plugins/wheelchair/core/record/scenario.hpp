// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/plant/slope.hpp"

namespace tandem::wheelchair {

/// Invalid input of the user. what() is one line with the file, the place and the remedy.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A test drive (docs/wheelchair.md, section 7): the user's stick movements, and the changes to the normal chair and
/// ground.
struct Scenario {
    std::string name;
    double seconds = 0.0;
    std::function<JoystickPosition(int tick)> stick; // without the emergency stop, see stick_at()
    double direction_rate = JoystickParameters{}.direction_rate;
    double weak_left = 1.0, weak_right = 1.0;
    double caster_left_deg = 0.0, caster_right_deg = 0.0;
    Slope slope;
    double emergency_stop_at = 1e9;           // s
    std::pair<double, double> mute{1e9, 1e9}; // JoystickComp sends nothing in [first, second) s

    int last_tick() const;                     // number of the last tick of HWComp
    JoystickPosition stick_at(int tick) const; // includes the emergency stop
    bool muted(double t) const;
};

/// Returns all scenarios in the order of docs/wheelchair.md, then `recorded`, whose stick comes from a file.
/// [any-thread]
const std::vector<Scenario>& scenarios();

/// Throws InputError with all names if no scenario has this name.
const Scenario& find_scenario(const std::string& name);

/// Returns the scenario `name`. If `joystick_file` is not empty, uses its stick positions, recorded or live
/// (live_stick.hpp). An empty name means `recorded` with a file, and `step20` without. Throws InputError.
Scenario load_scenario(const std::string& name, const std::string& joystick_file);

} // namespace tandem::wheelchair

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

/// Wrong input of the user. what() is one line that names the file, the place and what to do.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One test drive (docs/wheelchair.md, section 7): what the user does with the stick, and in what chair and
/// ground differ from the normal ones.
struct Scenario {
    std::string name;
    double seconds = 0.0;
    std::function<JoystickPosition(int tick)> stick; // without the emergency stop, for which see stick_at()
    double direction_rate = JoystickParameters{}.direction_rate;
    double weak_left = 1.0, weak_right = 1.0;
    double caster_left_deg = 0.0, caster_right_deg = 0.0;
    Slope slope;
    double emergency_stop_at = 1e9;           // s
    std::pair<double, double> mute{1e9, 1e9}; // JoystickComp sends nothing in [first, second) s

    int last_tick() const;                     // number of the last tick of HWComp
    JoystickPosition stick_at(int tick) const; // with the emergency stop
    bool muted(double t) const;
};

/// All scenarios, in the order of docs/wheelchair.md; then `recorded`, whose stick comes from a file.
/// [any-thread]
const std::vector<Scenario>& scenarios();

/// Throws InputError that lists all names if there is no scenario of this name.
const Scenario& find_scenario(const std::string& name);

/// The scenario `name`; if `joystick_file` is not empty, with the stick positions of that file, recorded
/// or live (live_stick.hpp). An empty name
/// means `recorded` with a file and `step20` without. Throws InputError.
Scenario load_scenario(const std::string& name, const std::string& joystick_file);

} // namespace tandem::wheelchair

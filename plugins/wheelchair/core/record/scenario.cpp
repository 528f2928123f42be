// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/scenario.hpp"

#include <cmath>
#include <memory>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/joystick_file.hpp"
#include "plugins/wheelchair/core/record/live_stick.hpp"

namespace tandem::wheelchair {

namespace {

// The inverse of JoystickLaw: 50 counts per degree, 1000 per m/s forward and 2000 in reverse, beyond a dead zone of 100
// counts.
double counts_for_direction(double deg) {
    if (deg == 0.0) return 0;
    const double c = std::floor(std::abs(deg) * 50.0 + 0.5) + 100;
    return deg > 0 ? c : -c;
}

double counts_for_speed(double v) {
    if (v == 0.0) return 0;
    const double c = std::floor(std::abs(v) * (v > 0 ? 1000.0 : 2000.0) + 0.5) + 100;
    return v > 0 ? c : -c;
}

/// From tick `from`, the stick requests this direction and speed.
struct Step {
    int from;
    double direction_deg, speed;
};

std::function<JoystickPosition(int)> steps(std::vector<Step> table) {
    return [table = std::move(table)](int n) {
        JoystickPosition stick;
        for (const Step& s : table)
            if (n >= s.from)
                stick = {counts_for_direction(s.direction_deg), counts_for_speed(s.speed), false};
        return stick;
    };
}

// s_curve: straight on, then a sinusoidal direction of 15 deg with a period of 5 s.
JoystickPosition slalom(int n) {
    if (n < 50) return {};
    if (n < 300) return {0, counts_for_speed(1.0), false};
    const double direction = 15.0 * std::sin(two_pi * (n - 300) * tick_seconds / 5.0);
    return {counts_for_direction(direction), counts_for_speed(1.0), false};
}

// doorway: straight on, stop, turn left on the spot by time, straight on.
JoystickPosition doorway(int n) {
    const bool turning = n >= 550 && n < 760;
    const bool driving = (n >= 50 && n < 450) || (n >= 860 && n < 1200);
    if (turning) return {2000, 0, false};
    return {0, driving ? counts_for_speed(0.5) : 0.0, false};
}

Scenario named(std::string name, double seconds, std::function<JoystickPosition(int)> stick) {
    Scenario s;
    s.name = std::move(name);
    s.seconds = seconds;
    s.stick = std::move(stick);
    return s;
}

// 5 deg, reached within half a second from `start_s`.
Slope uphill(double start_s) { return {5.0, start_s, 0.5, 0.0, true}; }

/// The paper's test and its variants. The paper's reference is electronic, so there is no rate limit.
std::vector<Scenario> step_family() {
    const auto turn = steps({{50, 0, .8}, {500, 20, .8}});
    std::vector<Scenario> list{named("step20", 10.0, turn),
                               named("step20_weak", 10.0, turn),
                               named("step20_slope", 14.0, turn),
                               named("start_caster90", 6.0, steps({{50, 0, .8}})),
                               named("turn_all", 14.0, steps({{50, 20, .8}})),
                               named("fast_saturated", 14.0, steps({{50, 0, 1.6}, {500, 12, 1.6}}))};
    for (Scenario& s : list) s.direction_rate = 0.0;
    for (int i : {1, 4, 5}) list[i].weak_right = 0.9;
    for (int i : {3, 4}) list[i].caster_left_deg = list[i].caster_right_deg = 90.0;
    list[2].slope = list[4].slope = uphill(7.0);
    list[5].slope = uphill(6.0);
    return list;
}

// The numbers are those in the table of docs/wheelchair.md, section 7.
std::vector<Scenario> all_scenarios() {
    std::vector<Scenario> list = step_family();
    list.push_back(named("s_curve", 15.0, slalom));
    list.push_back(named("doorway", 13.5, doorway));
    list.push_back(named("stop_full", 8.0, steps({{50, 0, 1.9}, {500, 0, 0}})));
    list.push_back(named("stop_turning", 8.0, steps({{50, 20, 1.2}, {500, 0, 0}})));
    list.push_back(named("estop", 8.0, steps({{50, 0, 1.9}})));
    list.back().emergency_stop_at = 5.0;
    list.push_back(named("stale", 12.0, steps({{50, 0, 1.0}, {300, 15, 1.0}, {800, 0, 0}, {920, 0, .6}})));
    list.back().mute = {5.0, 7.0};
    list.push_back(named("hill_start", 12.0, steps({{50, 0, .8}, {400, 0, 0}, {700, 0, .8}})));
    list.back().slope = uphill(2.0);
    list.push_back(named("reverse", 12.0, steps({{50, 0, .6}, {300, 0, 0}, {450, 0, -.4}})));
    list.back().caster_left_deg = list.back().caster_right_deg = 2.0;
    list.push_back(named("recorded", 10.0, [](int) { return JoystickPosition{}; }));
    return list;
}

} // namespace

int Scenario::last_tick() const { return static_cast<int>(std::lround(seconds / tick_seconds)); }

JoystickPosition Scenario::stick_at(int tick) const {
    JoystickPosition position = stick(tick);
    if (tick * tick_seconds >= emergency_stop_at - age_tolerance) position.emergency_stop = true;
    return position;
}

bool Scenario::muted(double t) const {
    return mute.first - age_tolerance <= t && t < mute.second - age_tolerance;
}

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> list = all_scenarios();
    return list;
}

const Scenario& find_scenario(const std::string& name) {
    std::string known;
    for (const Scenario& s : scenarios()) {
        if (s.name == name) return s;
        known += (known.empty() ? "" : ", ") + s.name;
    }
    throw InputError("no scenario '" + name + "'; there are " + known);
}

Scenario load_scenario(const std::string& name, const std::string& joystick_file) {
    const std::string fallback = joystick_file.empty() ? "step20" : "recorded";
    Scenario scenario = find_scenario(name.empty() ? fallback : name);
    if (joystick_file.empty()) return scenario;
    if (is_live_stick(joystick_file)) {
        const auto stick = std::make_shared<LiveStick>(joystick_file, LiveStick::Role::reader);
        scenario.stick = [stick](int) { return stick->read(); };
        return scenario;
    }
    const auto recording = std::make_shared<JoystickRecording>(read_joystick_file(joystick_file));
    if (scenario.name == "recorded") scenario.seconds = recording->seconds();
    scenario.stick = [recording](int n) { return recording->at(n * tick_seconds); };
    return scenario;
}

} // namespace tandem::wheelchair

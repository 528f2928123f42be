// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/wiring.hpp"

namespace tandem::wheelchair {

namespace {

// JoystickComp reads what HWComp published 6 ms before; ControlComp is looking out when JoystickComp sends;
// HWComp applies the voltages 4 ms later.
constexpr double hw_phase = 5.0, joystick_phase = 1.0, control_phase = 0.5;

std::vector<Wire> all_wires(const std::string& joystick) {
    return {{Wire::data, "HWComp", "joystickPos", joystick, "joystickPos"},
            {Wire::data, joystick, "reference", "ControlComp", "reference"},
            {Wire::data, "HWComp", "wheelSpeed", "ControlComp", "wheelSpeed"},
            {Wire::data, "ControlComp", "refVoltage", "HWComp", "refVoltage"},
            {Wire::service, joystick, "chair", "HWComp", "chair"},
            {Wire::service, "ControlComp", "joystick", joystick, "joystick"}};
}

} // namespace

std::vector<Member> opros_members(Configuration configuration) {
    if (configuration == Configuration::opros)
        return {{"HWComp", hw_phase}, {"JoystickComp", joystick_phase}, {"ControlComp", control_phase}};
    if (configuration == Configuration::mixed)
        return {{"HWComp", hw_phase}, {adaptor, 0.0}, {"ControlComp", control_phase}};
    return {};
}

std::vector<Member> rtm_members(Configuration configuration) {
    if (configuration == Configuration::rtm)
        return {{"HWComp", hw_phase}, {"JoystickComp", joystick_phase}, {"ControlComp", control_phase}};
    if (configuration == Configuration::mixed) return {{"JoystickComp", joystick_phase}};
    return {};
}

std::vector<Wire> opros_wires(Configuration configuration) {
    if (configuration == Configuration::opros) return all_wires("JoystickComp");
    if (configuration != Configuration::mixed) return {};
    auto wires = all_wires(adaptor);
    wires.push_back({Wire::data, adaptor, "linkState", "HWComp", "linkState"});
    return wires;
}

std::vector<Wire> rtm_wires(Configuration configuration) {
    return configuration == Configuration::rtm ? all_wires("JoystickComp") : std::vector<Wire>{};
}

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/wiring.hpp"

namespace tandem::wheelchair {

namespace {

// JoystickComp reads what HWComp published 6 ms before; ControlComp is looking out when JoystickComp sends;
// HWComp applies the voltages 4 ms later. ControlComp's looking out must keep nobody from a core, so its
// priority is lowest.
const Member hw{"HWComp", 5.0, 7}, joystick{"JoystickComp", 1.0, 6}, control{"ControlComp", 0.5, 5};

std::vector<Wire> all_wires(const std::string& stick) {
    return {{Wire::data, "HWComp", "joystickPos", stick, "joystickPos"},
            {Wire::data, stick, "reference", "ControlComp", "reference"},
            {Wire::data, "HWComp", "wheelSpeed", "ControlComp", "wheelSpeed"},
            {Wire::data, "ControlComp", "refVoltage", "HWComp", "refVoltage"},
            {Wire::service, stick, "chair", "HWComp", "chair"},
            {Wire::service, "ControlComp", "joystick", stick, "joystick"}};
}

} // namespace

std::vector<Bridge> bridges(Configuration configuration) {
    if (configuration == Configuration::mixed) return {{"Adaptor", "JoystickComp0", ""}};
    if (configuration == Configuration::swapped)
        return {{"HWAdaptor", "HWComp0", "-hw"}, {"ControlAdaptor", "ControlComp0", "-control"}};
    return {};
}

std::vector<Member> opros_members(Configuration configuration) {
    if (configuration == Configuration::opros) return {hw, joystick, control};
    if (configuration == Configuration::mixed) return {hw, {"Adaptor", 0.0, 0}, control};
    if (configuration == Configuration::swapped)
        return {{"HWAdaptor", 0.0, 0}, joystick, {"ControlAdaptor", 0.0, 0}};
    return {};
}

std::vector<Member> rtm_members(Configuration configuration) {
    if (configuration == Configuration::rtm) return {hw, joystick, control};
    if (configuration == Configuration::mixed) return {joystick};
    if (configuration == Configuration::swapped) return {hw, control};
    return {};
}

std::vector<Wire> opros_wires(Configuration configuration) {
    if (configuration == Configuration::opros) return all_wires("JoystickComp");
    if (configuration == Configuration::swapped)
        return {{Wire::data, "HWAdaptor", "joystickPos", "JoystickComp", "joystickPos"},
                {Wire::data, "JoystickComp", "reference", "ControlAdaptor", "reference"},
                {Wire::service, "JoystickComp", "chair", "HWAdaptor", "chair"},
                {Wire::service, "ControlAdaptor", "joystick", "JoystickComp", "joystick"}};
    if (configuration != Configuration::mixed) return {};
    auto wires = all_wires("Adaptor");
    wires.push_back({Wire::data, "Adaptor", "linkState", "HWComp", "linkState"});
    return wires;
}

std::vector<Wire> rtm_wires(Configuration configuration) {
    if (configuration == Configuration::rtm) return all_wires("JoystickComp");
    if (configuration == Configuration::swapped)
        return {{Wire::data, "HWComp", "wheelSpeed", "ControlComp", "wheelSpeed"},
                {Wire::data, "ControlComp", "refVoltage", "HWComp", "refVoltage"},
                {Wire::data, "InterceptorComp", "linkState", "HWComp", "linkState"}};
    return {};
}

} // namespace tandem::wheelchair

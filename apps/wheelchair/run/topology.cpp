// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/topology.hpp"

namespace tandem::wheelchair {

namespace {

// JoystickComp reads what HWComp published 6 ms before; ControlComp is looking out when JoystickComp sends;
// HWComp applies the voltages 4 ms later. ControlComp's looking out must keep nobody from a core, so its
// priority is lowest.
const RunComponent hw{"HWComp", 5.0, 7}, joystick{"JoystickComp", 1.0, 6}, control{"ControlComp", 0.5, 5};

std::vector<Connection> all_connections(const std::string& stick) {
    return {{Connection::data, "HWComp", "joystickPos", stick, "joystickPos"},
            {Connection::data, stick, "reference", "ControlComp", "reference"},
            {Connection::data, "HWComp", "wheelSpeed", "ControlComp", "wheelSpeed"},
            {Connection::data, "ControlComp", "refVoltage", "HWComp", "refVoltage"},
            {Connection::service, stick, "chair", "HWComp", "chair"},
            {Connection::service, "ControlComp", "joystick", stick, "joystick"}};
}

} // namespace

std::vector<Bridge> bridges(Configuration configuration) {
    if (configuration == Configuration::mixed) return {{"Adaptor", "JoystickComp0", ""}};
    if (configuration == Configuration::swapped)
        return {{"HWAdaptor", "HWComp0", "-hw"}, {"ControlAdaptor", "ControlComp0", "-control"}};
    return {};
}

std::vector<RunComponent> opros_components(Configuration configuration) {
    if (configuration == Configuration::opros) return {hw, joystick, control};
    if (configuration == Configuration::mixed) return {hw, {"Adaptor", 0.0, 0}, control};
    if (configuration == Configuration::swapped)
        return {{"HWAdaptor", 0.0, 0}, joystick, {"ControlAdaptor", 0.0, 0}};
    return {};
}

std::vector<RunComponent> rtm_components(Configuration configuration) {
    if (configuration == Configuration::rtm) return {hw, joystick, control};
    if (configuration == Configuration::mixed) return {joystick};
    if (configuration == Configuration::swapped) return {hw, control};
    return {};
}

std::vector<Connection> opros_connections(Configuration configuration) {
    if (configuration == Configuration::opros) return all_connections("JoystickComp");
    if (configuration == Configuration::swapped)
        return {{Connection::data, "HWAdaptor", "joystickPos", "JoystickComp", "joystickPos"},
                {Connection::data, "JoystickComp", "reference", "ControlAdaptor", "reference"},
                {Connection::service, "JoystickComp", "chair", "HWAdaptor", "chair"},
                {Connection::service, "ControlAdaptor", "joystick", "JoystickComp", "joystick"}};
    if (configuration != Configuration::mixed) return {};
    auto connections = all_connections("Adaptor");
    connections.push_back({Connection::data, "Adaptor", "linkState", "HWComp", "linkState"});
    return connections;
}

std::vector<Connection> rtm_connections(Configuration configuration) {
    if (configuration == Configuration::rtm) return all_connections("JoystickComp");
    if (configuration == Configuration::swapped)
        return {{Connection::data, "HWComp", "wheelSpeed", "ControlComp", "wheelSpeed"},
                {Connection::data, "ControlComp", "refVoltage", "HWComp", "refVoltage"},
                {Connection::data, "InterceptorComp", "linkState", "HWComp", "linkState"}};
    return {};
}

} // namespace tandem::wheelchair

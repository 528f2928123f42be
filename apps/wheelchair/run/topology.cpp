// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/topology.hpp"

namespace tandem::wheelchair {

namespace {

// Sequence within 10 ms: HWComp publishes at 5 ms. JoystickComp reads that at 11 ms and sends a reference. ControlComp
// has polled for it since 10.5 ms. HWComp applies the voltages at 15 ms. ControlComp has the lowest priority, so that
// polling does not block the other two.
const RunComponent hw{"HWComp", 5.0, 7}, joystick{"JoystickComp", 1.0, 6}, control{"ControlComp", 0.5, 5};

// Returns all connections of the wheelchair (docs/wheelchair.md, section 5). `stick` and `law`: instances with the
// ports of JoystickComp and ControlComp, which are these components or the AdaptorComps that mirror them.
std::vector<Connection> all_connections(const std::string& stick, const std::string& law) {
    return {{Connection::data, "HWComp", "joystickPos", stick, "joystickPos"},
            {Connection::data, stick, "reference", law, "reference"},
            {Connection::data, "HWComp", "wheelSpeed", law, "wheelSpeed"},
            {Connection::data, law, "refVoltage", "HWComp", "refVoltage"},
            {Connection::service, stick, "chair", "HWComp", "chair"},
            {Connection::service, law, "joystick", stick, "joystick"}};
}

} // namespace

std::vector<Bridge> bridges(Configuration configuration) {
    if (configuration == Configuration::mixed) return {{"Adaptor", "JoystickComp0", ""}};
    if (configuration == Configuration::swapped)
        return {{"HWAdaptor", "HWComp0", "-hw"}, {"ControlAdaptor", "ControlComp0", "-control"}};
    if (configuration == Configuration::split) return {{"ControlAdaptor", "ControlComp0", ""}};
    return {};
}

std::vector<RunComponent> opros_components(Configuration configuration) {
    if (configuration == Configuration::opros) return {hw, joystick, control};
    if (configuration == Configuration::mixed) return {hw, {"Adaptor", 0.0, 0}, control};
    if (configuration == Configuration::swapped)
        return {{"HWAdaptor", 0.0, 0}, joystick, {"ControlAdaptor", 0.0, 0}};
    if (configuration == Configuration::split) return {hw, joystick, {"ControlAdaptor", 0.0, 0}};
    return {};
}

std::vector<RunComponent> rtm_components(Configuration configuration) {
    if (configuration == Configuration::rtm) return {hw, joystick, control};
    if (configuration == Configuration::mixed) return {joystick};
    if (configuration == Configuration::swapped) return {hw, control};
    if (configuration == Configuration::split) return {control};
    return {};
}

std::vector<Connection> opros_connections(Configuration configuration) {
    if (configuration == Configuration::opros) return all_connections("JoystickComp", "ControlComp");
    if (configuration == Configuration::swapped)
        return {{Connection::data, "HWAdaptor", "joystickPos", "JoystickComp", "joystickPos"},
                {Connection::data, "JoystickComp", "reference", "ControlAdaptor", "reference"},
                {Connection::service, "JoystickComp", "chair", "HWAdaptor", "chair"},
                {Connection::service, "ControlAdaptor", "joystick", "JoystickComp", "joystick"}};
    const bool split = configuration == Configuration::split;
    if (configuration != Configuration::mixed && !split) return {};
    const std::string adaptor = bridges(configuration).front().adaptor;
    auto connections =
        split ? all_connections("JoystickComp", adaptor) : all_connections(adaptor, "ControlComp");
    connections.push_back({Connection::data, adaptor, "linkState", "HWComp", "linkState"});
    return connections;
}

std::vector<Connection> rtm_connections(Configuration configuration) {
    if (configuration == Configuration::rtm) return all_connections("JoystickComp", "ControlComp");
    if (configuration == Configuration::swapped)
        return {{Connection::data, "HWComp", "wheelSpeed", "ControlComp", "wheelSpeed"},
                {Connection::data, "ControlComp", "refVoltage", "HWComp", "refVoltage"},
                {Connection::data, "InterceptorComp", "linkState", "HWComp", "linkState"}};
    return {};
}

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
// What the three OPRoS components share: their ports' type, their properties, and how they report a refusal.
#pragma once

#include <Component.h>
#include <InputDataPort.h>
#include <OPRoSTypes.h>
#include <OutputDataPort.h>

#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"

namespace tandem::wheelchair::component {

using Values = std::vector<double>;
constexpr int queue_length = 16;

/// Most messages taken in one tick, so that a mad sender cannot hold it: more than a sender at 10 ms leaves behind
/// while this process was paused for half a minute, since what is newest only comes after all that is old.
constexpr int max_messages_per_tick = 4096;

/// Empties the port.
template <class T>
Received<T> receive_all(InputDataPort<Values>& port) {
    Received<T> in;
    for (int i = 0; i < max_messages_per_tick; ++i) {
        const std::unique_ptr<opros_any> any(port.pop());
        if (!any) break;
        in.add(*port.getContentPointer(*any));
    }
    return in;
}

template <class T>
void push(OutputDataPort<Values>& port, Values& buffer, const Stamped<T>& value) {
    const auto message = pack(value);
    buffer.assign(message.begin(), message.end());
    port.push(buffer);
}

inline Settings settings_of(Component& component) {
    return read_settings({component.getProperty("scenario"), component.getProperty("joystick_file"),
                          component.getProperty("clock"), component.getProperty("poll_us"),
                          component.getProperty("trace")});
}

/// Runs a step of the component's life; a refusal becomes one line and an error code for the engine.
template <class Step>
ReturnType guarded(const char* component, Step step) {
    try {
        step();
        return OPROS_SUCCESS;
    } catch (const std::exception& e) {
        std::cerr << component << ": " << e.what() << std::endl;
        return OPROS_INTERNAL_FAULT;
    }
}

} // namespace tandem::wheelchair::component

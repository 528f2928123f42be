// SPDX-License-Identifier: Apache-2.0
// Shared by the three OPRoS components: the type of their ports, their properties, and error reports.
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

/// The type of all data ports.
using Values = std::vector<double>;
/// Capacity of a port. Senders tick every 10 ms, so a reader may be late by 150 ms.
constexpr int queue_length = 16;

/// Limits the messages per tick, so that a continuous sender cannot block the tick. The limit exceeds the messages of a
/// 10 ms sender in half a minute of pause, because the newest message is behind all older ones.
constexpr int max_messages_per_tick = 4096;

/// Takes all messages from the port. [tick-thread]
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

/// Sends a value. `buffer` keeps its memory between ticks, so that no tick allocates. [tick-thread]
template <class T>
void push(OutputDataPort<Values>& port, Values& buffer, const Stamped<T>& value) {
    const auto message = pack(value);
    buffer.assign(message.begin(), message.end());
    port.push(buffer);
}

/// Returns the component's validated properties. Throws InputError.
inline Settings settings_of(Component& component) {
    return read_settings({component.getProperty("scenario"), component.getProperty("joystick_file"),
                          component.getProperty("clock"), component.getProperty("poll_us"),
                          component.getProperty("trace")});
}

/// Runs a life-cycle callback. Converts an exception to one line on standard error and an error code for the engine.
template <class Step>
ReturnType run_guarded(const char* component, Step step) {
    try {
        step();
        return OPROS_SUCCESS;
    } catch (const std::exception& e) {
        std::cerr << component << ": " << e.what() << std::endl;
        return OPROS_INTERNAL_FAULT;
    }
}

} // namespace tandem::wheelchair::component

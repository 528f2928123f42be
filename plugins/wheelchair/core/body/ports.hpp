// SPDX-License-Identifier: Apache-2.0
// What a component's body asks of its ports. The OPRoS and the RTM component each implement this with the
// ports of their model; the bodies are the same. All calls come from the thread that ticks.
#pragma once

#include <optional>

#include "plugins/wheelchair/core/body/messages.hpp"

namespace tandem::wheelchair {

/// What an in-port held: its newest message, and how many there were (older ones are counted, then
/// discarded).
template <class T>
struct Received {
    std::optional<Stamped<T>> newest;
    int count = 0;

    /// Takes the next older-to-newer message in; false when it is malformed.
    bool add(std::span<const double> message) {
        const auto value = unpack<T>(message);
        if (!value) return false;
        newest = value;
        ++count;
        return true;
    }
};

class JoystickPorts {
  public:
    virtual Received<JoystickPosition> positions() = 0;
    virtual void send(const Stamped<Reference>& reference) = 0;

  protected:
    ~JoystickPorts() = default;
};

class ControlPorts {
  public:
    virtual Received<Reference> references() = 0;
    virtual Received<WheelSpeed> wheels() = 0;
    virtual void send(const Stamped<Voltage>& voltage) = 0;

  protected:
    ~ControlPorts() = default;
};

class HWPorts {
  public:
    virtual Received<Voltage> voltages() = 0;
    virtual Received<LinkState> link_states() = 0; // empty when no link is connected
    virtual void send(const Stamped<JoystickPosition>& position, const Stamped<WheelSpeed>& wheels) = 0;

  protected:
    ~HWPorts() = default;
};

} // namespace tandem::wheelchair

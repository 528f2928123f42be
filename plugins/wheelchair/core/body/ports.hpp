// SPDX-License-Identifier: Apache-2.0
// The port interface of the bodies. The OPRoS and RTM components implement it with their models' ports and share the
// bodies. The thread that ticks calls all functions.
#pragma once

#include <optional>

#include "plugins/wheelchair/core/body/messages.hpp"

namespace tandem::wheelchair {

/// All messages in an in-port: the newest one, and the number of messages.
template <class T>
struct Received {
    std::optional<Stamped<T>> newest;
    int count = 0;

    /// Adds a message that is newer than the previous ones. Ignores a malformed message and returns false.
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
    virtual Received<LinkState> link_states() = 0; // empty if the port is not connected
    virtual void send(const Stamped<JoystickPosition>& position, const Stamped<WheelSpeed>& wheels) = 0;

  protected:
    ~HWPorts() = default;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/input.h>

#include <optional>
#include <string>

#include "host/process/file_descriptor.hpp"
#include "plugins/wheelchair/core/law/signals.hpp"

namespace tandem::wheelchair {

/// A gamepad or joystick of Linux's evdev interface (Documentation/input/input.rst of the kernel). The left stick
/// drives; its middle tenth is a dead zone. The right one of the four buttons (B, circle), or a joystick's thumb
/// button, is the emergency stop. [one thread]
class Gamepad {
  public:
    /// Range of an axis as reported by the device.
    struct Axis {
        int low = -32768, high = 32767, now = 0;
    };

    /// `file`: an open non-blocking device, or another source of input_event.
    Gamepad(process::FileDescriptor file, Axis x, Axis y) : file_(std::move(file)), x_(x), y_(y) {}

    /// Returns the first readable device in /dev/input with two axes and the buttons of a gamepad or joystick.
    static std::optional<Gamepad> find();

    /// Reads new events. Returns false if the device is gone.
    bool update();
    /// Returns x to the left and y forward, in counts up to 2000, and whether the emergency stop was pressed since the
    /// last call.
    JoystickPosition position();
    int fd() const { return file_.get(); }

  private:
    void handle(const input_event& event);

    process::FileDescriptor file_;
    Axis x_, y_;
    bool stop_ = false;
};

} // namespace tandem::wheelchair

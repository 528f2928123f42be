// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/input.h>

#include <optional>
#include <string>

#include "host/process/file_descriptor.hpp"
#include "plugins/wheelchair/core/law/signals.hpp"

namespace tandem::wheelchair {

/// A gamepad or joystick of Linux's evdev interface (Documentation/input/input.rst of the kernel). The left stick drives;
/// its middle tenth is a dead zone. The right one of the four buttons (B, circle), or a joystick's thumb button, is the
/// emergency stop. [one thread]
class Gamepad {
  public:
    /// The range of an axis as the device reports it.
    struct Axis {
        int low = -32768, high = 32767, now = 0;
    };

    /// `file`: an open device, non-blocking, or whatever delivers input_event.
    Gamepad(process::FileDescriptor file, Axis x, Axis y) : file_(std::move(file)), x_(x), y_(y) {}

    /// The first device with two axes and a gamepad's or joystick's buttons in /dev/input that may be read.
    static std::optional<Gamepad> find();

    /// Reads what has happened. Returns false if the device is gone.
    bool update();
    /// x to the left, y forward, whole counts to 2000. The emergency stop is that since the last call of position().
    JoystickPosition position();
    int fd() const { return file_.get(); }

  private:
    void handle(const input_event& event);

    process::FileDescriptor file_;
    Axis x_, y_;
    bool stop_ = false;
};

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/wheelchair/run/run_directory.hpp"
#include "host/process/file_descriptor.hpp"
#include "plugins/wheelchair/core/law/signals.hpp"
#include "plugins/wheelchair/core/record/live_stick.hpp"

#include <atomic>
#include <filesystem>
#include <linux/input.h>
#include <optional>
#include <string>
#include <thread>

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
    Gamepad(process::FileDescriptor file, Axis x, Axis y, std::string name = {})
        : file_(std::move(file)), x_(x), y_(y), name_(std::move(name)) {}

    /// Returns the first readable device in /dev/input with two axes and the buttons of a gamepad or joystick.
    static std::optional<Gamepad> find();

    /// Reads new events. Returns false if the device is gone.
    bool update();
    /// Returns x to the left and y forward, in counts up to 2000, and whether the emergency stop was pressed since the
    /// last call.
    JoystickPosition position();
    int fd() const { return file_.get(); }
    /// Returns what the device calls itself, and its file.
    const std::string& name() const { return name_; }

  private:
    void handle(const input_event& event);

    process::FileDescriptor file_;
    Axis x_, y_;
    std::string name_;
    bool stop_ = false;
};

/// Lets a person drive with a gamepad, which may come and go, or otherwise with positions that the page of `tandem
/// monitor` sends to a socket. A silent sender counts as a released stick. An emergency stop from either lasts until
/// the end of the run.
class LiveDrive {
  public:
    /// A position as a datagram: three doubles x, y (counts, see JoystickPosition) and emergency stop.
    struct Command {
        double x, y, emergency_stop;
    };

    /// Creates stick and socket in a folder that only this user can access, and starts the thread. Throws InputError.
    LiveDrive();
    ~LiveDrive();
    LiveDrive(const LiveDrive&) = delete;
    LiveDrive& operator=(const LiveDrive&) = delete;

    std::string stick_file() const { return (folder_.path() / "stick").string(); }
    std::string socket() const { return (folder_.path() / "drive").string(); }

  private:
    void run();
    void look_for_gamepad();
    void drive_by_gamepad();
    void drive_by_socket();

    Folder folder_;
    LiveStick stick_;
    process::FileDescriptor socket_;
    std::optional<Gamepad> gamepad_;
    double next_look_ = 0.0; // CLOCK_MONOTONIC [s] of the next search for a gamepad
    bool emergency_stop_ = false;
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

} // namespace tandem::wheelchair

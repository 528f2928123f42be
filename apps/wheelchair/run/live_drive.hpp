// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "apps/wheelchair/run/gamepad.hpp"
#include "apps/wheelchair/run/run_directory.hpp"
#include "plugins/wheelchair/core/record/live_stick.hpp"

namespace tandem::wheelchair {

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

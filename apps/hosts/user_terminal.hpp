// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/file_descriptor.hpp"

#include <memory>
#include <string_view>
#include <sys/ioctl.h>
#include <termios.h>
#include <utility>

namespace tandem::hosts {

/// The terminal from which a user controls this program. While this program is in the foreground, the terminal
/// hands over each key at once and shows none; Ctrl-C, Ctrl-\ and Ctrl-Z still send signals.
class UserTerminal {
  public:
    /// Returns nullptr if the descriptor is not a terminal that can be opened again.
    static std::unique_ptr<UserTerminal> open(int descriptor);
    ~UserTerminal() { release(); }
    UserTerminal(const UserTerminal&) = delete;
    UserTerminal& operator=(const UserTerminal&) = delete;

    /// Returns whether this program is in the foreground, and takes the terminal over if it came there since the
    /// last call.
    bool in_foreground();
    /// Restores the settings that the terminal had when it was taken over.
    void release();

    /// Returns the descriptor for reading keys. It does not block.
    int descriptor() const { return terminal_.get(); }
    /// Returns the settings for terminals of other programs.
    const termios& settings() const { return settings_; }
    winsize size() const;
    /// Writes text without waiting. Text for which the terminal has no room is lost.
    void show(std::string_view text) const;

  private:
    UserTerminal(process::FileDescriptor terminal, const termios& settings)
        : terminal_(std::move(terminal)), settings_(settings) {}

    process::FileDescriptor terminal_;
    termios settings_;
    bool taken_ = false;
};

} // namespace tandem::hosts

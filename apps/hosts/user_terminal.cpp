// SPDX-License-Identifier: Apache-2.0
#include "apps/hosts/user_terminal.hpp"

#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace tandem::hosts {
namespace {

// Ctrl-C keeps its meaning (ISIG). The terminal of each host translates Enter (ICRNL).
termios settings_for_keys(termios settings) {
    settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
    settings.c_iflag &= ~static_cast<tcflag_t>(ICRNL | INLCR | IGNCR);
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    return settings;
}

} // namespace

// Opens it again, because O_NONBLOCK of the given descriptor would also change it for other programs.
std::unique_ptr<UserTerminal> UserTerminal::open(int descriptor) {
    termios settings{};
    if (tcgetattr(descriptor, &settings) != 0) return nullptr;
    process::FileDescriptor terminal(::open(fmt::format("/proc/self/fd/{}", descriptor).c_str(),
                                            O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!terminal) return nullptr;
    // The shell may take the foreground between this check and the change of settings.
    std::signal(SIGTTOU, SIG_IGN);
    return std::unique_ptr<UserTerminal>(new UserTerminal(std::move(terminal), settings));
}

bool UserTerminal::in_foreground() {
    const pid_t foreground = tcgetpgrp(terminal_.get());
    if (foreground >= 0 &&
        foreground != getpgrp()) { // -1: not the terminal of this session, without job control
        taken_ = false;            // the shell has set it up for the program in the foreground
        return false;
    }
    if (taken_) return true;
    if (tcgetattr(terminal_.get(), &settings_) != 0) return false;
    const termios keys = settings_for_keys(settings_);
    taken_ = tcsetattr(terminal_.get(), TCSANOW, &keys) == 0;
    return taken_;
}

void UserTerminal::release() {
    if (std::exchange(taken_, false)) tcsetattr(terminal_.get(), TCSANOW, &settings_);
}

winsize UserTerminal::size() const {
    winsize size{};
    ioctl(terminal_.get(), TIOCGWINSZ, &size);
    return size;
}

void UserTerminal::show(std::string_view text) const {
    if (taken_) static_cast<void>(!write(terminal_.get(), text.data(), text.size()));
}

} // namespace tandem::hosts

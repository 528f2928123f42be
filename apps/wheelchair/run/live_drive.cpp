// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/live_drive.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "apps/tandem/output/print_note.hpp"
#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

namespace {

constexpr int refresh_ms = 20;     // a gamepad that does not move sends nothing
constexpr double look_pause = 1.0; // [s] between two searches for a gamepad
constexpr int datagrams_at_once = 64;

std::filesystem::path drive_folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tandem-drive-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw InputError(pattern + ": cannot be created: " + std::strerror(errno) +
                         "; set TMPDIR to a writable folder");
    return pattern;
}

process::FileDescriptor drive_socket(const std::string& path) {
    process::FileDescriptor file(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path)
        throw InputError(path +
                         ": too long for the name of a socket; set TMPDIR to a folder with a shorter path");
    path.copy(address.sun_path, path.size());
    if (file.get() < 0 || bind(file.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw InputError(path + ": cannot listen: " + std::strerror(errno));
    return file;
}

} // namespace

LiveDrive::LiveDrive()
    : folder_(drive_folder(), false), stick_(stick_file(), LiveStick::Role::writer),
      socket_(drive_socket(socket())), thread_([this] { run(); }) {}

LiveDrive::~LiveDrive() {
    ends_ = true;
    thread_.join();
}

void LiveDrive::run() {
    sigset_t all; // only the main thread handles signals, to stop the hosts in order
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    while (!ends_) {
        look_for_gamepad();
        pollfd files[] = {{socket_.get(), POLLIN, 0}, {gamepad_ ? gamepad_->fd() : -1, POLLIN, 0}};
        poll(files, 2, refresh_ms);
        drive_by_gamepad();
        drive_by_socket();
    }
    stick_.write({0.0, 0.0, emergency_stop_});
}

void LiveDrive::look_for_gamepad() {
    if (gamepad_ || monotonic_seconds() < next_look_) return;
    next_look_ = monotonic_seconds() + look_pause;
    gamepad_ = Gamepad::find();
    if (gamepad_) command::print_note("wheelchair: driving with the gamepad\n");
}

void LiveDrive::drive_by_gamepad() {
    if (!gamepad_) return;
    if (!gamepad_->update()) {
        gamepad_.reset();
        stick_.write({0.0, 0.0, emergency_stop_});
        command::print_note("wheelchair: the gamepad was disconnected; its stick counts as released\n");
        return;
    }
    JoystickPosition position = gamepad_->position();
    emergency_stop_ = position.emergency_stop = emergency_stop_ || position.emergency_stop;
    stick_.write(position);
}

/// Uses the newest command that has arrived. Ignores datagrams of another size; LiveStick limits the
/// values.
void LiveDrive::drive_by_socket() {
    std::optional<Command> newest;
    for (int i = 0; i < datagrams_at_once; ++i) {
        Command command{};
        const auto bytes = recv(socket_.get(), &command, sizeof command, MSG_TRUNC);
        if (bytes < 0) break;
        if (bytes != sizeof command) continue;
        newest = command;
        emergency_stop_ = emergency_stop_ || command.emergency_stop != 0.0;
    }
    if (newest && !gamepad_) stick_.write({newest->x, newest->y, emergency_stop_});
}

} // namespace tandem::wheelchair

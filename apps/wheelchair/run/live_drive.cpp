// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/live_drive.hpp"

#include "apps/tandem/output/print_note.hpp"
#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace tandem::wheelchair {
namespace {

constexpr double dead_zone = 0.1;

bool has_bit(const std::array<unsigned char, KEY_MAX / 8 + 1>& bits, unsigned bit) {
    return (bits[bit / 8] >> (bit % 8) & 1U) != 0;
}

std::optional<Gamepad::Axis> axis_of(int fd, unsigned axis) {
    input_absinfo info{};
    if (ioctl(fd, EVIOCGABS(axis), &info) < 0 || info.minimum >= info.maximum) return {};
    return Gamepad::Axis{info.minimum, info.maximum, info.value};
}

/// Returns the deflection from -1 to 1, with 0 in the dead zone.
double deflection(const Gamepad::Axis& axis) {
    const double low = axis.low, high = axis.high;
    const double value = std::clamp(2.0 * (axis.now - low) / (high - low) - 1.0, -1.0, 1.0);
    const double beyond = std::max(0.0, std::abs(value) - dead_zone) / (1.0 - dead_zone);
    return std::copysign(beyond, value);
}

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

std::optional<Gamepad> Gamepad::find() {
    std::error_code none; // the machine may have no input devices
    for (const auto& entry : std::filesystem::directory_iterator("/dev/input", none)) {
        if (entry.path().filename().string().rfind("event", 0) != 0) continue;
        process::FileDescriptor file(open(entry.path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
        if (file.get() < 0) continue;
        std::array<unsigned char, KEY_MAX / 8 + 1> keys{};
        if (ioctl(file.get(), EVIOCGBIT(EV_KEY, keys.size()), keys.data()) < 0) continue;
        if (!has_bit(keys, BTN_GAMEPAD) && !has_bit(keys, BTN_JOYSTICK)) continue;
        const auto x = axis_of(file.get(), ABS_X), y = axis_of(file.get(), ABS_Y);
        std::array<char, 128> name{};
        ioctl(file.get(), EVIOCGNAME(name.size() - 1), name.data()); // without a name it stays empty
        if (x && y)
            return Gamepad(std::move(file), *x, *y,
                           fmt::format("{} ({})", name.data(), entry.path().string()));
    }
    return {};
}

bool Gamepad::update() {
    std::array<input_event, 64> events; // NOLINT(cppcoreguidelines-pro-type-member-init): filled by read()
    for (int reads = 0; reads < 16; ++reads) { // limited, so that a flooding device cannot block this thread
        const auto bytes = read(file_.get(), events.data(), sizeof events);
        if (bytes < 0) return errno == EAGAIN || errno == EINTR;
        if (bytes == 0) return false;
        for (std::size_t i = 0; i < static_cast<std::size_t>(bytes) / sizeof(input_event); ++i)
            handle(events[i]);
    }
    return true;
}

void Gamepad::handle(const input_event& event) {
    if (event.type == EV_ABS && event.code == ABS_X) x_.now = event.value;
    if (event.type == EV_ABS && event.code == ABS_Y) y_.now = event.value;
    if (event.type == EV_KEY && event.value != 0 && (event.code == BTN_EAST || event.code == BTN_THUMB))
        stop_ = true;
    if (event.type != EV_SYN || event.code != SYN_DROPPED) return;
    // The kernel has dropped events. Reads the axes again; the button may also have been pressed.
    if (const auto x = axis_of(file_.get(), ABS_X)) x_ = *x;
    if (const auto y = axis_of(file_.get(), ABS_Y)) y_ = *y;
    std::array<unsigned char, KEY_MAX / 8 + 1> keys{};
    if (ioctl(file_.get(), EVIOCGKEY(keys.size()), keys.data()) >= 0)
        stop_ = stop_ || has_bit(keys, BTN_EAST) || has_bit(keys, BTN_THUMB);
}

JoystickPosition Gamepad::position() {
    const double end = JoystickParameters{}.max_count;
    // The device counts to the right and towards the driver.
    return {std::round(-deflection(x_) * end), std::round(-deflection(y_) * end),
            std::exchange(stop_, false)};
}

LiveDrive::LiveDrive()
    : folder_(drive_folder(), false), stick_(stick_file(), LiveStick::Role::writer),
      socket_(drive_socket(socket())), thread_([this] { run(); }) {}

LiveDrive::~LiveDrive() {
    ends_ = true;
    thread_.join();
}

void LiveDrive::run() {
    sigset_t all; // only the main thread handles signals, to stop the hosts cleanly
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
    if (gamepad_)
        command::print_note(
            "wheelchair: driving with the gamepad {}; its button B (circle) is the emergency stop\n",
            gamepad_->name());
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

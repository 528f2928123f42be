// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/gamepad.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <filesystem>

#include "plugins/wheelchair/core/plant/parameters.hpp"

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
        if (x && y) return Gamepad(std::move(file), *x, *y);
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

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
// Driving by hand: a gamepad whose events come through a pipe, one that the kernel makes where this user may ask for it
// (uinput), and the socket.
#include "apps/wheelchair/run/live_drive.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <functional>
#include <thread>

using namespace tandem::wheelchair;
using namespace std::chrono_literals;
using tandem::process::FileDescriptor;

namespace {

/// A gamepad with axes from 0 to 200, at rest at 100, and the end of the pipe at which its events are written.
struct PipeGamepad {
    PipeGamepad() : PipeGamepad(ends()) {}
    void send(unsigned short type, unsigned short code, int value) const {
        input_event event{};
        event.type = type;
        event.code = code;
        event.value = value;
        REQUIRE(write(input.get(), &event, sizeof event) == sizeof event);
    }
    FileDescriptor input;
    Gamepad gamepad;

  private:
    struct Ends {
        int read, write;
    };
    static Ends ends() {
        int both[2];
        REQUIRE(pipe2(both, O_NONBLOCK) == 0);
        return {both[0], both[1]};
    }
    explicit PipeGamepad(Ends ends)
        : input(ends.write), gamepad(FileDescriptor(ends.read), {0, 200, 100}, {0, 200, 100}) {}
};

/// A gamepad with the same axes that the kernel has like any other, from creation to destruction.
class KernelGamepad {
  public:
    /// Returns whether this user may create devices; the other tests need this right.
    explicit KernelGamepad() : file_(open("/dev/uinput", O_WRONLY | O_NONBLOCK | O_CLOEXEC)) {
        if (!is_permitted()) return;
        for (const int kind : {EV_KEY, EV_ABS}) REQUIRE(ioctl(file_.get(), UI_SET_EVBIT, kind) == 0);
        for (const int key : {BTN_SOUTH, BTN_EAST}) REQUIRE(ioctl(file_.get(), UI_SET_KEYBIT, key) == 0);
        for (const int axis : {ABS_X, ABS_Y}) {
            uinput_abs_setup setup{};
            setup.code = static_cast<__u16>(axis);
            setup.absinfo.maximum = 200;
            setup.absinfo.value = 100;
            REQUIRE(ioctl(file_.get(), UI_ABS_SETUP, &setup) == 0);
        }
        uinput_setup setup{};
        setup.id.bustype = BUS_VIRTUAL;
        std::strncpy(setup.name, "Tandem test gamepad", sizeof setup.name - 1);
        REQUIRE(ioctl(file_.get(), UI_DEV_SETUP, &setup) == 0);
        REQUIRE(ioctl(file_.get(), UI_DEV_CREATE) == 0);
    }
    bool is_permitted() const { return file_.get() >= 0; }
    void send(unsigned short type, unsigned short code, int value) const {
        input_event events[2]{};
        events[0].type = type;
        events[0].code = code;
        events[0].value = value;
        events[1].type = EV_SYN;
        REQUIRE(write(file_.get(), events, sizeof events) == sizeof events);
    }
    void unplug() { file_ = FileDescriptor(); }

  private:
    FileDescriptor file_;
};

/// Returns whether the stick reaches the wanted position.
bool becomes(const LiveStick& stick, const std::function<bool(const JoystickPosition&)>& wanted) {
    for (int i = 0; i < 2000 && !wanted(stick.read()); ++i) std::this_thread::sleep_for(5ms);
    return wanted(stick.read());
}

void send(const LiveDrive& drive, const void* bytes, std::size_t size) {
    const FileDescriptor file(::socket(AF_UNIX, SOCK_DGRAM, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    drive.socket().copy(address.sun_path, sizeof address.sun_path - 1);
    CHECK(sendto(file.get(), bytes, size, 0, reinterpret_cast<const sockaddr*>(&address), sizeof address) ==
          static_cast<ssize_t>(size));
}

/// Sends a position again and again until the stick has it.
bool drives(const LiveDrive& drive, const LiveStick& stick, const LiveDrive::Command& command,
            const std::function<bool(const JoystickPosition&)>& wanted) {
    for (int i = 0; i < 1000; ++i) {
        send(drive, &command, sizeof command);
        std::this_thread::sleep_for(5ms);
        if (wanted(stick.read())) return true;
    }
    return false;
}

} // namespace

TEST_CASE("a gamepad's left stick drives, up is forward and left is left") {
    PipeGamepad pad;
    CHECK(pad.gamepad.update());
    CHECK(pad.gamepad.position().x == 0);
    pad.send(EV_ABS, ABS_X, 0);
    pad.send(EV_ABS, ABS_Y, 0);
    CHECK(pad.gamepad.update());
    CHECK(pad.gamepad.position().x == 2000);
    CHECK(pad.gamepad.position().y == 2000);
    pad.send(EV_ABS, ABS_Y, 145); // half of what is beyond the dead zone would be 155
    CHECK(pad.gamepad.update());
    CHECK(pad.gamepad.position().y == -778);
}

TEST_CASE("a gamepad that does not rest exactly in the middle does not move the chair") {
    PipeGamepad pad;
    for (const int value : {90, 95, 105, 110}) {
        pad.send(EV_ABS, ABS_X, value);
        pad.send(EV_ABS, ABS_Y, value);
        CHECK(pad.gamepad.update());
        CHECK(pad.gamepad.position().x == 0);
        CHECK(pad.gamepad.position().y == 0);
    }
}

TEST_CASE("values beyond the range of an axis, and events of other kinds, are bounded or ignored") {
    PipeGamepad pad;
    pad.send(EV_ABS, ABS_X, 2'000'000'000);
    pad.send(EV_ABS, ABS_RX, 0);
    pad.send(EV_REL, REL_X, 5);
    pad.send(EV_SYN, SYN_DROPPED, 0);
    CHECK(pad.gamepad.update());
    const auto position = pad.gamepad.position();
    CHECK(position.x == -2000);
    CHECK(position.y == 0);
    CHECK_FALSE(position.emergency_stop);
}

TEST_CASE("the emergency-stop button is reported once per press, even for a short press") {
    PipeGamepad pad;
    pad.send(EV_KEY, BTN_SOUTH, 1);
    CHECK(pad.gamepad.update());
    CHECK_FALSE(pad.gamepad.position().emergency_stop);
    pad.send(EV_KEY, BTN_EAST, 1);
    pad.send(EV_KEY, BTN_EAST, 0);
    CHECK(pad.gamepad.update());
    CHECK(pad.gamepad.position().emergency_stop);
    CHECK_FALSE(pad.gamepad.position().emergency_stop);
}

TEST_CASE("an unplugged gamepad is gone") {
    PipeGamepad pad;
    pad.send(EV_ABS, ABS_Y, 0);
    pad.input = FileDescriptor();
    pad.gamepad.update(); // reads what was sent
    CHECK_FALSE(pad.gamepad.update());
}

TEST_CASE("positions at the socket move the stick, and silence releases it") {
    const LiveDrive drive;
    const LiveStick stick(drive.stick_file(), LiveStick::Role::reader);
    CHECK(stick.read().y == 0);
    REQUIRE(drives(drive, stick, {-300, 1500, 0}, [](const auto& p) { return p.x == -300 && p.y == 1500; }));
    std::this_thread::sleep_for(250ms);
    CHECK(stick.read().x == 0);
    CHECK(stick.read().y == 0);
    // An invalid position moves nothing; a position beyond the stick's end is its end.
    send(drive, "nonsense", 8);
    const std::string long_one(5000, 'x');
    send(drive, long_one.data(), long_one.size());
    CHECK(drives(drive, stick, {1e300, std::nan(""), 0},
                 [](const auto& p) { return p.x == 2000 && p.y == 0; }));
}

TEST_CASE("an emergency stop at the socket stays until the drive ends") {
    const LiveDrive drive;
    const LiveStick stick(drive.stick_file(), LiveStick::Role::reader);
    REQUIRE(drives(drive, stick, {0, 500, 1}, [](const auto& p) { return p.emergency_stop; }));
    CHECK(drives(drive, stick, {0, 700, 0}, [](const auto& p) { return p.y == 700 && p.emergency_stop; }));
    std::this_thread::sleep_for(250ms);
    CHECK(stick.read().emergency_stop);
}

TEST_CASE("a gamepad plugged in while driving moves the stick, and unplugging it releases the stick") {
    const LiveDrive drive;
    const LiveStick stick(drive.stick_file(), LiveStick::Role::reader);
    KernelGamepad pad;
    if (!pad.is_permitted()) TANDEM_SKIP("/dev/uinput cannot be opened here; the other tests use a pipe");
    // Found at the next search; a device's values count from its first event on.
    bool forward = false;
    for (int i = 0; i < 100 && !forward; ++i) {
        pad.send(EV_ABS, ABS_Y, i % 2); // an unchanged value causes no event
        std::this_thread::sleep_for(50ms);
        forward = stick.read().y > 1900;
    }
    REQUIRE(forward);
    pad.send(EV_ABS, ABS_X, 0);
    CHECK(becomes(stick, [](const auto& p) { return p.x == 2000; }));
    pad.unplug();
    CHECK(becomes(stick, [](const auto& p) { return p.x == 0 && p.y == 0; }));
    KernelGamepad again;
    bool stopped = false;
    for (int i = 0; i < 100 && !stopped; ++i) {
        again.send(EV_KEY, BTN_EAST, i % 2);
        std::this_thread::sleep_for(50ms);
        stopped = stick.read().emergency_stop;
    }
    CHECK(stopped);
}

// SPDX-License-Identifier: Apache-2.0
// The three components' bodies, joined by queues in this process, as a host joins them in lock-step.
#include <catch2/catch.hpp>

#include "plugins/wheelchair/core/body/clock.hpp"
#include "plugins/wheelchair/core/body/control_body.hpp"
#include "plugins/wheelchair/core/body/hw_body.hpp"
#include "plugins/wheelchair/core/body/joystick_body.hpp"
#include "plugins/wheelchair/core/law/limits.hpp"
#include "plugins/wheelchair/core/record/rows.hpp"
#include "tests/apps/wheelchair/scratch_dir.hpp"
#include "tests/plugins/wheelchair/read_trace.hpp"

#include <thread>

using namespace tandem::wheelchair;

namespace {

template <class T>
class Queue {
  public:
    void put(const Stamped<T>& value) { in_.add(pack(value)); }
    Received<T> receive_all() { return std::exchange(in_, {}); }

  private:
    Received<T> in_;
};

class Wires final : public JoystickPorts, public ControlPorts, public HWPorts {
  public:
    Received<JoystickPosition> positions() override { return positions_.receive_all(); }
    Received<Reference> references() override { return references_.receive_all(); }
    Received<WheelSpeed> wheels() override { return wheels_.receive_all(); }
    Received<Voltage> voltages() override { return voltages_.receive_all(); }
    Received<LinkState> link_states() override { return links_.receive_all(); }
    void send(const Stamped<Reference>& r) override { references_.put(r); }
    void send(const Stamped<Voltage>& v) override {
        voltages_.put(v);
        last_voltage = v.value;
    }
    void send(const Stamped<JoystickPosition>& p, const Stamped<WheelSpeed>& w) override {
        positions_.put(p);
        wheels_.put(w);
    }
    Queue<LinkState> links_;
    Voltage last_voltage;

  private:
    Queue<JoystickPosition> positions_;
    Queue<Reference> references_;
    Queue<WheelSpeed> wheels_;
    Queue<Voltage> voltages_;
};

/// All three in lock-step, recording into `dir`.
struct Run {
    explicit Run(const ScratchDir& dir, const std::string& scenario)
        : joystick(settings(dir, scenario, "joystick"), chair_limits()),
          control(settings(dir, scenario, "control")), hw(settings(dir, scenario, "hw")) {
        hw.publish(wires);
    }
    static Settings settings(const ScratchDir& dir, const std::string& scenario,
                             const std::string& component) {
        RawSettings texts;
        texts.scenario = scenario;
        texts.clock = "simulated";
        texts.trace = dir / (component + ".trace");
        return read_settings(texts);
    }
    void steps(int ticks) {
        for (int n = 0; n < ticks; ++n) {
            joystick.tick(wires);
            control.tick(wires);
            hw.tick(wires);
        }
    }
    Wires wires;
    JoystickBody joystick;
    ControlBody control;
    HWBody hw;
};

std::vector<Row> merged(const ScratchDir& dir, int last_tick) {
    return merge(read_trace<HWRecord>(dir / "hw.trace"), read_trace<JoystickRecord>(dir / "joystick.trace"),
                 read_trace<ControlRecord>(dir / "control.trace"), last_tick);
}

bool stopped(const HWBody& hw) {
    const auto v = hw.chair().applied();
    return v.left == 0.0 && v.right == 0.0 && v.brake;
}

} // namespace

TEST_CASE("the merged traces of the components are the in-memory run, byte for byte") {
    for (const Scenario& scenario : scenarios()) {
        const ScratchDir dir;
        Run run(dir, scenario.name);
        run.steps(scenario.last_tick());
        run.joystick.tick(run.wires);
        run.control.tick(run.wires);
        INFO(scenario.name);
        CHECK(csv_text(merged(dir, scenario.last_tick())) == csv_text(simulate(scenario)));
    }
}

TEST_CASE("a row whose publication a component missed holds that component's last values") {
    const ScratchDir dir;
    Run run(dir, "step20");
    run.steps(200);
    run.hw.tick(run.wires); // JoystickComp and ControlComp were late
    run.steps(10);
    const auto rows = merged(dir, 205);
    REQUIRE(rows.size() == 206);
    CHECK(rows[200].volts_left == rows[199].volts_left);
    CHECK(rows[201].volts_left != rows[200].volts_left);
    CHECK(rows[200].t == Approx(2.0));
    CHECK(rows[200].wheel_left_measured != 0.0);
}

TEST_CASE("the chair stops in the tick after the link went down and drives on once it is up") {
    const ScratchDir dir;
    Run run(dir, "step20");
    run.steps(300);
    REQUIRE_FALSE(stopped(run.hw));
    run.wires.links_.put({0, 0, {false}});
    run.steps(1);
    CHECK(stopped(run.hw));
    run.steps(3);
    CHECK(stopped(run.hw));
    run.wires.links_.put({0, 1, {true}});
    run.steps(1);
    CHECK_FALSE(stopped(run.hw));
    CHECK(read_trace<HWRecord>(dir / "hw.trace")[301].link_up == 0.0);
}

TEST_CASE("an emergency stop requested by service stops the chair and reaches ControlComp") {
    const ScratchDir dir;
    Run run(dir, "step20");
    run.steps(300);
    run.hw.emergency_stop();
    run.steps(1);
    CHECK(stopped(run.hw));
    run.steps(1);
    CHECK(run.control.state() == ControlState::emergency_stop);
}

TEST_CASE("a deactivated ControlComp sets the voltage to zero and applies the brake") {
    const ScratchDir dir;
    Run run(dir, "step20");
    run.steps(300);
    REQUIRE(run.wires.last_voltage.left > 1.0);
    run.control.deactivate(run.wires);
    CHECK(run.wires.last_voltage.left == 0.0);
    CHECK(run.wires.last_voltage.brake);
}

TEST_CASE("ages count from ControlComp's first tick, so a late start is not a fault") {
    Wires wires;
    ControlBody control(read_settings({}));
    wires.send(Stamped<JoystickPosition>{}, Stamped<WheelSpeed>{0.0, 0, {}}); // published long ago
    control.tick(wires);
    CHECK(control.state() == ControlState::run);
}

TEST_CASE("a JoystickComp that was started again slows the chair down instead of jerking it") {
    const ScratchDir dir;
    Run run(dir, "step20");
    run.steps(300);
    REQUIRE(run.control.state() == ControlState::run);
    const double before = run.wires.last_voltage.left;
    RawSettings texts;
    texts.clock = "simulated";
    JoystickBody restarted(read_settings(texts), chair_limits());
    restarted.tick(run.wires); // within 50 ms, and from speed 0
    run.control.tick(run.wires);
    CHECK(run.control.state() == ControlState::stale);
    CHECK(run.wires.last_voltage.left > before - 2.0);
}

TEST_CASE("a JoystickComp whose stick position is old sends nothing, because the driver may have let go") {
    JoystickBody joystick(read_settings({}), chair_limits()); // monotonic time
    Wires wires;
    wires.send(Stamped<JoystickPosition>{monotonic_seconds() - 1.0, 100, {0.0, 900.0, false}}, {});
    joystick.tick(wires);
    CHECK_FALSE(wires.references().newest);
    wires.send(Stamped<JoystickPosition>{monotonic_seconds(), 200, {0.0, 900.0, false}}, {});
    joystick.tick(wires);
    CHECK(wires.references().newest);
}

TEST_CASE("a reference from the tick before does not end the polling for this tick's one") {
    RawSettings texts;
    texts.poll_us = "5000";
    ControlBody control(read_settings(texts));
    Wires wires;
    const double old = monotonic_seconds() - 0.0095;
    wires.send(Stamped<Reference>{old, 1, {}});
    const double start = monotonic_seconds();
    control.tick(wires);
    CHECK(monotonic_seconds() - start >= 0.005); // polled for the whole time
}

TEST_CASE("a reference of a machine whose clock is ahead becomes stale like any other") {
    Wires wires;
    ControlBody control(read_settings({.clock = "simulated"}));
    double sequence = 0;
    const auto tick = [&] {
        ++sequence;
        wires.send({0.0, sequence, JoystickPosition{}}, {0.01 * sequence, sequence, WheelSpeed{}});
        control.tick(wires);
    };
    wires.send(Stamped<Reference>{1e6, 1.0, {0.0, 0.5}});
    for (int n = 0; n < 6; ++n) tick();
    CHECK(control.state() == ControlState::run); // 50 ms old
    tick();
    CHECK(control.state() == ControlState::stale);
}

TEST_CASE("with the clock arrival a message that the network has held back is as old as it is") {
    SentTime sent(ClockKind::arrival);
    CHECK(sent.of(5000.0, 1.0) == 1.0); // nothing is known yet
    CHECK(sent.of(5000.01, 1.03) == Approx(1.01));
    CHECK(sent.of(5000.02, 1.015) == Approx(1.015)); // the quickest
    CHECK(sent.of(5000.1, 1.5) == Approx(1.095));
    // The sender's machine was switched off and on: its clock started again.
    CHECK(sent.of(3.0, 20.0) < 20.0 - 4000.0);
    CHECK(sent.of(9.0, 26.0) == Approx(26.0));
    CHECK(sent.of(9.01, 26.3) == Approx(26.01));
}

TEST_CASE("a message without a time counts as late") {
    for (const ClockKind clock : {ClockKind::arrival, ClockKind::monotonic, ClockKind::simulated})
        CHECK(SentTime(clock).of(std::numeric_limits<double>::quiet_NaN(), 10.0) < 0.0);
}

TEST_CASE(
    "with the clock arrival the age of a message counts from its arrival, whatever its sender's clock says") {
    for (const std::string clock : {"arrival", "monotonic"}) {
        Wires wires;
        ControlBody control(read_settings({.clock = clock}));
        const auto tick = [&](double sequence) {
            const double now = monotonic_seconds();
            wires.send({now, sequence, JoystickPosition{}}, {now, sequence, WheelSpeed{}});
            control.tick(wires);
        };
        const double start = monotonic_seconds();
        wires.send(Stamped<Reference>{-1e6, 1.0, {}});
        tick(1.0);
        std::this_thread::sleep_for(std::chrono::milliseconds(80));
        wires.send(Stamped<Reference>{-1e6 + monotonic_seconds() - start, 2.0, {}});
        tick(2.0);
        CHECK(control.state() == (clock == "arrival" ? ControlState::run : ControlState::stale));
        std::this_thread::sleep_for(std::chrono::milliseconds(80));
        tick(3.0);
        CHECK(control.state() == ControlState::stale);
    }
}

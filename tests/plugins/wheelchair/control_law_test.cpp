// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <limits>
#include <utility>

#include "plugins/wheelchair/core/law/control_law.hpp"

using namespace tandem::wheelchair;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A law that has driven straight for one second; the chair is imagined to follow exactly.
struct Driving {
    ControlLaw law;
    double t = 0.0;
    const Reference straight{0.0, 0.5};
    const WheelSpeed following{0.5 / 0.17, 0.5 / 0.17, false, 0, 0};

    Driving() {
        for (int n = 0; n < 100; ++n) tick(n * tick_seconds, t, t);
    }
    Voltage tick(double now, double reference_stamp, double wheel_stamp) {
        t = now;
        return law.tick(now, {reference_stamp, 0, straight}, {wheel_stamp, 0, following});
    }
};

bool stopped(const Voltage& v) { return v.left == 0.0 && v.right == 0.0 && v.brake; }

} // namespace

TEST_CASE("a number that is not finite is a fault, latched") {
    Driving d;
    const auto bad = GENERATE(values<Reference>({{not_a_number, 0.5}, {0.0, not_a_number}}));
    CHECK(stopped(d.law.tick(1.0, {1.0, 0, bad}, {1.0, 0, d.following})));
    CHECK(d.law.state() == ControlState::fault);
    CHECK(stopped(d.tick(1.01, 1.01, 1.01)));
    CHECK(d.law.state() == ControlState::fault);
}

TEST_CASE("a wheel speed that is not finite is a fault") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const auto& [left, right] :
         {std::pair{not_a_number, 1.0}, {1.0, not_a_number}, {infinite, 1.0}, {1.0, -infinite}}) {
        CAPTURE(left, right);
        Driving d;
        CHECK(stopped(d.law.tick(1.0, {1.0, 0, d.straight}, {1.0, 0, {left, right, false, 0, 0}})));
        CHECK(d.law.state() == ControlState::fault);
    }
}

TEST_CASE("a wheel speed 50 ms old is accepted and one 60 ms old is a fault") {
    Driving d;
    CHECK_FALSE(stopped(d.tick(1.04, 1.04, 0.99)));
    CHECK(d.law.state() == ControlState::run);
    CHECK(stopped(d.tick(1.05, 1.05, 0.99)));
    CHECK(d.law.state() == ControlState::fault);
    CHECK(stopped(d.tick(1.06, 1.06, 1.06)));
}

TEST_CASE("the emergency stop acts at once and is latched, even over a later fault") {
    Driving d;
    CHECK(stopped(d.law.tick(1.0, {1.0, 0, d.straight}, {1.0, 0, {3.0, 3.0, true, 0, 0}})));
    CHECK(d.law.state() == ControlState::emergency_stop);
    CHECK(stopped(d.tick(1.01, 1.01, 1.01)));
    CHECK(stopped(d.law.tick(1.02, {1.02, 0, {not_a_number, 0}}, {1.02, 0, d.following})));
    CHECK(d.law.state() == ControlState::emergency_stop);
}

TEST_CASE("a reference 60 ms old slows the chair down, and only a released stick ends that") {
    Driving d;
    CHECK_FALSE(stopped(d.tick(1.05, 0.99, 1.05)));
    CHECK(d.law.state() == ControlState::stale);
    d.tick(1.06, 1.06, 1.06); // fresh again, but the stick is still pushed
    CHECK(d.law.state() == ControlState::stale);
    const WheelSpeed standing{};
    for (double t = 1.07; t < 1.5; t += 0.01) d.law.tick(t, {t, 0, d.straight}, {t, 0, standing});
    CHECK(d.law.state() == ControlState::stale);
    d.law.tick(1.5, {1.5, 0, {0.0, 0.0}}, {1.5, 0, standing});
    CHECK(d.law.state() == ControlState::run);
}

TEST_CASE("the difference voltage comes first when the voltage does not suffice") {
    ControlLaw law;
    Voltage v;
    for (int n = 0; n < 300; ++n) {
        const double t = n * tick_seconds;
        v = law.tick(t, {t, 0, {20.0, 1.9}}, {t, 0, {4.0, 4.0, false, 0, 0}}); // chair held back, straight
    }
    CHECK(v.right - v.left == Approx(24.0));     // the difference at its limit of 12 V
    CHECK(v.right == Approx(22.8).margin(1e-9)); // the mean gets the rest
}

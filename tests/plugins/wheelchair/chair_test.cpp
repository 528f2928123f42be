// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <limits>

#include "plugins/wheelchair/core/plant/chair.hpp"

using namespace tandem::wheelchair;

namespace {

const Scenario& any_scenario() { return find_scenario("step20"); }

/// Lets the chair drive straight on 6 V for `ticks`, a voltage in every tick.
Chair driving(int ticks) {
    Chair chair(any_scenario(), 0.0);
    for (int n = 0; n < ticks; ++n) {
        chair.apply(n * tick_seconds, Stamped<Voltage>{n * tick_seconds, double(n), {6.0, 6.0, false}},
                    false);
        chair.advance();
    }
    return chair;
}

bool stopped(const Chair& c) {
    return c.applied().left == 0.0 && c.applied().right == 0.0 && c.applied().brake;
}

} // namespace

TEST_CASE("the watchdog sets both voltages to 0 60 ms after the last voltage") {
    Chair chair = driving(101); // the last voltage is stamped 1.00 s
    for (int n = 101; n <= 105; ++n) {
        chair.apply(n * tick_seconds, std::nullopt, false);
        INFO("tick " << n);
        CHECK(chair.applied().left == Approx(6.0).margin(0.01));
        CHECK_FALSE(chair.watchdog_acts());
        chair.advance();
    }
    chair.apply(106 * tick_seconds, std::nullopt, false);
    CHECK(stopped(chair));
    CHECK(chair.watchdog_acts());
}

TEST_CASE("without any voltage the watchdog acts 60 ms after it was started") {
    Chair chair(any_scenario(), 0.0);
    for (int n = 0; n <= 5; ++n) {
        chair.apply(n * tick_seconds, std::nullopt, false);
        CHECK_FALSE(chair.watchdog_acts());
        chair.advance();
    }
    chair.apply(6 * tick_seconds, std::nullopt, false);
    CHECK(chair.watchdog_acts());
}

TEST_CASE("a forced stop overrides a fresh voltage in the same tick") {
    Chair chair = driving(100);
    chair.apply(1.0, Stamped<Voltage>{1.0, 100, {6.0, 6.0, false}}, true);
    CHECK(stopped(chair));
    chair.advance();
    chair.apply(1.01, Stamped<Voltage>{1.01, 101, {6.0, 6.0, false}}, false);
    CHECK_FALSE(stopped(chair));
}

TEST_CASE("a voltage that is not a number stops the chair") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Chair chair = driving(100);
    chair.apply(1.0, Stamped<Voltage>{1.0, 100, {nan, 6.0, false}}, false);
    CHECK(stopped(chair));
}

TEST_CASE("a voltage stamped in the future does not put the watchdog to sleep") {
    Chair chair = driving(100);
    chair.apply(1.0, Stamped<Voltage>{1e6, 100, {6.0, 6.0, false}}, false);
    chair.advance();
    chair.apply(1.07, std::nullopt, false);
    CHECK(stopped(chair));
}

TEST_CASE("the parking brake closes only once the wheels are slow and stays closed until the brake opens") {
    Chair chair = driving(200);
    REQUIRE(chair.wheel_speed().left > 1.0);
    chair.apply(2.0, Stamped<Voltage>{2.0, 200, {0.0, 0.0, true}}, false);
    CHECK_FALSE(chair.parking_brake());
    int closed_at = 0;
    for (int n = 201; n < 500 && closed_at == 0; ++n) {
        chair.advance();
        chair.apply(n * tick_seconds, Stamped<Voltage>{n * tick_seconds, double(n), {0.0, 0.0, true}}, false);
        if (chair.parking_brake()) closed_at = n;
    }
    CHECK(closed_at > 201);
    CHECK(chair.wheel_speed().left < 1.0);
    chair.apply(5.0, Stamped<Voltage>{5.0, 500, {6.0, 6.0, false}}, false);
    CHECK_FALSE(chair.parking_brake());
}

TEST_CASE("voltages are rounded to PWM steps and limited to the duty of the driver") {
    Chair chair(any_scenario(), 0.0);
    chair.apply(0.0, Stamped<Voltage>{0.0, 0, {100.0, 1.0, false}}, false);
    CHECK(chair.applied().left == Approx(22.8).margin(0.012));
    CHECK(chair.applied().right == 85.0 / 2048 * 24);
}

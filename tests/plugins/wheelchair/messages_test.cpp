// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/law/limits.hpp"

using namespace tandem::wheelchair;

TEST_CASE("a message is stamp, sequence number and elements, and is read back unchanged") {
    const Stamped<WheelSpeed> sent{1.25, 125, {2.0, 3.0, true, 400, 500}};
    const auto message = pack(sent);
    CHECK(std::vector<double>(message.begin(), message.end()) ==
          std::vector<double>{1.25, 125, 2, 3, 1, 400, 500});
    const auto back = unpack<WheelSpeed>(message);
    REQUIRE(back);
    CHECK(pack(*back) == message);
}

TEST_CASE("a message of another length or without a finite stamp is ignored") {
    CHECK_FALSE(unpack<Reference>(std::vector<double>{1, 2, 3}));
    CHECK_FALSE(unpack<Reference>(std::vector<double>{1, 2, 3, 4, 5}));
    CHECK_FALSE(unpack<Reference>(std::vector<double>{}));
    CHECK_FALSE(unpack<Reference>(std::vector<double>{NAN, 2, 3, 4}));
    CHECK(unpack<Reference>(std::vector<double>{1, 2, NAN, 4}));
}

TEST_CASE("draining a port keeps the newest message and counts all good ones") {
    Received<Reference> in;
    CHECK(in.add(std::vector<double>{0.01, 1, 10, 0.5}));
    CHECK_FALSE(in.add(std::vector<double>{0.01, 1}));
    CHECK(in.add(std::vector<double>{0.02, 2, 20, 0.6}));
    CHECK(in.count == 2);
    CHECK(in.newest->value.direction_deg == 20);
}

TEST_CASE("limits that are not four positive numbers are refused in one line") {
    CHECK(chair_limits_from(chair_limits()).forward == 1.9);
    CHECK_THROWS_AS(chair_limits_from({1, 2, 3}), InputError);
    CHECK_THROWS_AS(chair_limits_from({1, 2, 3, 0}), InputError);
    CHECK_THROWS_AS(check_joystick(-1, 120), InputError);
    CHECK_NOTHROW(check_joystick(100, 0));
}

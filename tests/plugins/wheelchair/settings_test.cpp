// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "plugins/wheelchair/core/body/settings.hpp"

using namespace tandem::wheelchair;

TEST_CASE("empty parameters mean step20 on the monotonic clock, unrecorded") {
    const auto s = read_settings({});
    CHECK(s.scenario.name == "step20");
    CHECK(s.clock == ClockKind::monotonic);
    CHECK(s.poll_seconds == 0.0);
    CHECK(s.trace.empty());
}

TEST_CASE("a parameter that makes no sense is named with what it may be") {
    CHECK_THROWS_WITH(read_settings({.clock = "wall"}),
                      "parameter clock is 'wall'; expected monotonic, simulated or arrival");
    CHECK(read_settings({.clock = "arrival"}).clock == ClockKind::arrival);
    CHECK_THROWS_WITH(read_settings({.poll_us = "3ms"}), Catch::Contains("poll_us is '3ms'"));
    CHECK_THROWS_WITH(read_settings({.poll_us = "10000"}), Catch::Contains("below 10000"));
    CHECK_THROWS_WITH(read_settings({.poll_us = "nan"}), Catch::Contains("poll_us"));
    CHECK_THROWS_WITH(read_settings({.scenario = "walk"}), Catch::Contains("no scenario 'walk'"));
    CHECK_THROWS_WITH(read_ratio_gain("much"), Catch::Contains("ratio_gain is 'much'"));
    CHECK(read_ratio_gain("") == 16.0);
    CHECK(read_ratio_gain("8.5") == 8.5);
    CHECK(read_settings({.clock = "simulated", .poll_us = "3000"}).poll_seconds == Approx(0.003));
}

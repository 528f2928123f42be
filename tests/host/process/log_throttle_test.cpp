// SPDX-License-Identifier: Apache-2.0
#include "host/process/log_throttle.hpp"

#include <catch2/catch.hpp>
#include <vector>

TEST_CASE("a throttled message is logged at its 1st, 2nd, 4th, 8th and 16th occurrence") {
    tandem::process::LogThrottle throttle;
    std::vector<std::uint64_t> logged;
    for (int i = 0; i < 20; ++i)
        if (throttle.should_log()) logged.push_back(throttle.count());
    CHECK(logged == std::vector<std::uint64_t>{1, 2, 4, 8, 16});
}

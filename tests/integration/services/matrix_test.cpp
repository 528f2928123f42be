// SPDX-License-Identifier: Apache-2.0
#include "MatrixCells.h"
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>

#include <iostream>

TEST_CASE("every shape of service with every type crosses in both directions") {
    TwoHosts hosts;
    hosts.set_talker("ServiceMatrixComp");
    hosts.set_rtc("ServiceMatrixRtc");
    // Two providers and a consumer on one port of the RTC.
    hosts.set_connections(TwoHosts::connection("service", "Talker", "first", "Adaptor", "matrix.first") +
                          TwoHosts::connection("service", "Talker", "second", "Adaptor", "matrix.second") +
                          TwoHosts::connection("service", "Adaptor", "matrix.third", "Talker", "matrix"));
    hosts.start_rtm();
    hosts.start_opros();
    const auto all_of = [](const std::string& cells, int count) {
        return cells + std::to_string(count) + " of " + std::to_string(count) + " passed";
    };
    const std::string to_rtm = all_of("cells OPRoS to RTM: ", MATRIX_CELLS_TO_RTM),
                      to_opros = all_of("cells RTM to OPRoS: ", MATRIX_CELLS_TO_OPROS);
    CHECK(hosts.says("rtm", "cells RTM to OPRoS: "));
    REQUIRE(hosts.says("opros", "cells OPRoS to RTM: "));
    const auto second = hosts.output("opros").find("cells OPRoS to RTM: ") + 1;
    CHECK(hosts.says("opros", "cells OPRoS to RTM: ", second));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK_THAT(hosts.output("rtm"), Catch::Contains(to_opros) && !Catch::Contains("failed:"));
    CHECK_THAT(hosts.output("opros"), Catch::Contains(to_rtm) && !Catch::Contains("failed:"));
    // One line at connection for the operation that cannot cross.
    CHECK_THAT(hosts.output("opros"),
               Catch::Contains(
                   "operation 'not_crossing' of interface Matrix::Service cannot be called, the others can: "
                   "argument 'a': a type that contains itself"));
    // Each refused value is explained, up to a limit.
    CHECK_THAT(hosts.output("rtm"),
               Catch::Contains("an argument cannot cross: an any contains a type that cannot") &&
                   Catch::Contains("its result cannot cross: a fixed is '1.234'"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    std::cout << "service cells: 2 x " << MATRIX_CELLS_TO_RTM << " + " << MATRIX_CELLS_TO_OPROS << " = "
              << 2 * MATRIX_CELLS_TO_RTM + MATRIX_CELLS_TO_OPROS << " passed\n";
}

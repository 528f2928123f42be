// SPDX-License-Identifier: Apache-2.0
// Every kind of type, in both directions, with every queue policy: one cell each.
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>

#include <iostream>

namespace {

const std::vector<std::string> kinds = {
#define KIND(name, idl, opros, value) #name,
#include "kinds.inc"
#undef KIND
};
const std::vector<std::string> policies = {"fifo", "last", "lifo", "ufifo"};

} // namespace

TEST_CASE("every kind of type crosses in both directions with every policy") {
    TwoHosts hosts;
    hosts.set_talker("MatrixComp");
    hosts.set_rtc("MatrixRtc");
    std::string connections;
    for (const auto& kind : kinds) {
        connections += TwoHosts::connection("data", "Talker", kind, "Adaptor", kind);
        for (const auto& policy : policies)
            connections +=
                TwoHosts::connection("data", "Adaptor", kind + "Back", "Talker", kind + "_" + policy);
    }
    for (const char* port : {"AnyRequest", "AnyReturned"})
        connections += TwoHosts::connection("data", "Talker", port, "Adaptor", port);
    connections += TwoHosts::connection("data", "Adaptor", "AnySent", "Talker", "AnySent");
    hosts.set_connections(connections);
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "all kinds received"));
    const std::string output = hosts.output("opros");
    std::size_t cells = 0;
    const auto check_cell = [&](const std::string& cell) {
        INFO(cell);
        const bool ok = output.find("cell: " + cell + ": ok") != std::string::npos;
        CHECK(ok);
        cells += ok ? 1 : 0;
    };
    for (const auto& kind : kinds) {
        check_cell(kind + ", to RTM, push");
        for (const auto& policy : policies) check_cell(kind + ", to OPRoS, " + policy);
    }
    // An any of each type there and back, and one that cannot cross.
    CHECK(hosts.says("rtm", "cells of anys: "));
    const std::string anys = hosts.output("rtm");
    INFO(anys);
    CHECK_THAT(anys, !Catch::Contains("WRONG") && Catch::Contains("recursive refused") &&
                         Catch::Contains("an any contains a type that cannot cross: a type that "
                                         "contains itself"));
    std::size_t any_cells = 0;
    for (std::size_t at = 0; (at = anys.find("there and back: ok", at)) != std::string::npos; ++at)
        ++any_cells;
    CHECK_THAT(anys, Catch::Contains("cells of anys: " + std::to_string(any_cells) + " of " +
                                     std::to_string(any_cells)));
    CHECK(any_cells > 30);
    std::cout << "matrix of data ports: " << cells + 2 * any_cells << " of "
              << kinds.size() * (1 + policies.size()) + 2 * any_cells << " cells ok, " << 2 * any_cells
              << " of anys\n";
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

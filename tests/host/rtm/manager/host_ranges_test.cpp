// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/host_ranges.hpp"

#include <catch2/catch.hpp>

using RTC::HostRanges;

TEST_CASE("A list of machines contains the addresses and networks that it names, and no others") {
    CHECK_FALSE(HostRanges().contains("192.168.0.1"));
    CHECK(HostRanges().empty());
    const HostRanges hosts({"192.168.0.2", "10.1.2.3/16", "fd00::1", "fd77::5/64"});
    CHECK_FALSE(hosts.empty());
    for (const char* inside :
         {"192.168.0.2", "10.1.0.0", "10.1.255.255", "fd00::1", "fd77::", "fd77::ffff:1"})
        CHECK(hosts.contains(inside));
    for (const char* outside : {"192.168.0.3", "10.2.0.0", "10.0.255.255", "fd00::2", "fd77:0:0:1::1", "::1",
                                "127.0.0.1", "", "localhost", "10.1.0.0/16"})
        CHECK_FALSE(hosts.contains(outside));
    CHECK(HostRanges({"10.0.0.0/8", "all"}).contains("fe80::1"));
    CHECK(HostRanges({"0.0.0.0/0"}).contains("8.8.8.8"));
    CHECK_FALSE(HostRanges({"0.0.0.0/0"}).contains("fe80::1"));
}

TEST_CASE("An entry of a list of machines that is not an address is an error that names it") {
    for (const char* wrong :
         {"robot", "192.168.0", "192.168.0.1/33", "192.168.0.1/", "fd00::/129", "192.168.0.1:2810", "*", ""})
        CHECK_THROWS_WITH(HostRanges({wrong}),
                          Catch::StartsWith(std::string("'") + wrong + "' is not an address"));
}

// SPDX-License-Identifier: Apache-2.0
// What links cost that do nothing.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

#include <sys/stat.h>

namespace {

constexpr std::uintmax_t ports_per_link = 16;

std::uintmax_t memory_of(const std::filesystem::path& file) {
    struct stat status {};
    return stat(file.c_str(), &status) == 0 ? 512 * static_cast<std::uintmax_t>(status.st_blocks)
                                            : UINTMAX_MAX;
}

} // namespace

TEST_CASE("a link whose ports are idle takes at most 64 KiB of shared memory for each port") {
    TwoHosts hosts;
    hosts.set_talker("");
    hosts.set_rtc("PortsRtc");
    hosts.set_connections("");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "16 ports of PortsRtc0 mirrored"));
    REQUIRE(hosts.says("opros", "ready"));
    const auto segments = hosts.segments();
    REQUIRE(segments.size() == 1);
    const auto memory = memory_of(segments[0]);
    std::printf("%ju KiB of shared memory for a link with %ju idle ports, %ju KiB for each\n", memory / 1024,
                ports_per_link, memory / 1024 / ports_per_link);
    CHECK(memory <= ports_per_link * 64 * 1024);
    CHECK(hosts.stop_both());
}

// SPDX-License-Identifier: Apache-2.0
// The largest number of links in one pair of hosts that the documentation promises.
#include "two_hosts.hpp"

#include "tests/support/context_switches.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>

#include <sys/stat.h>

namespace {

constexpr int links = 64;
constexpr std::uintmax_t ports_per_link = 16, max_memory_per_port = 64 * 1024;

/// An AdaptorComp and a PortsRtc for each link, and unless they are idle, a PortsComp.
struct ManyLinks : TwoHosts {
    explicit ManyLinks(int number_of_links = links, bool idle = false) {
        set_talker("");
        set_rtc("PortsRtc");
        set_adaptor_properties("");
        std::string connections;
        for (int i = 0; i < number_of_links; ++i) {
            const std::string number = std::to_string(i), adaptor = i == 0 ? "Adaptor" : "Adaptor" + number;
            if (i != 0) {
                add_rtc("PortsRtc");
                add_link(adaptor, "PortsRtc" + number);
            }
            if (idle) continue;
            add_component("Ports" + number, "PortsComp", property("number", number));
            for (int port = 0; port < 8; ++port) {
                const std::string of_port = std::to_string(port);
                connections +=
                    connection("data", "Ports" + number, "out" + of_port, adaptor, "in" + of_port) +
                    connection("data", adaptor, "out" + of_port, "Ports" + number, "in" + of_port);
            }
        }
        set_connections(connections);
    }
};

std::uintmax_t memory_of(const std::filesystem::path& file) {
    struct stat status {};
    return stat(file.c_str(), &status) == 0 ? 512 * static_cast<std::uintmax_t>(status.st_blocks)
                                            : UINTMAX_MAX;
}

/// Returns the memory of a process, including shared memory, in bytes.
std::uintmax_t resident_memory(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/smaps_rollup");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("Rss:")) return 1024 * std::stoull(line.substr(4));
    return 0;
}

/// Returns the memory of the two hosts of this number of idle links, once they are ready.
std::map<std::string, std::uintmax_t> memory_with_idle_links(int number_of_links) {
    ManyLinks hosts(number_of_links, true);
    hosts.start_rtm();
    hosts.start_opros();
    std::map<std::string, std::uintmax_t> memory;
    for (const char* host : {"opros", "rtm"}) {
        REQUIRE(hosts.says(host, "\nready\n"));
        memory[host] = resident_memory(hosts.pid(host));
    }
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.stop_both());
    return memory;
}

/// Returns the context switches of the threads that watch the links of a host.
long supervisor_switches(pid_t host) {
    long sum = 0;
    for (const auto& [thread, count] : tandem::test::count_context_switches(host))
        if (thread.find("tandem-link") != std::string::npos) sum += count;
    return sum;
}

// Set up, a link's supervisor has left its processor some 20 times: with one that all events woke it was 650 times.
constexpr long max_switches_per_link = 100;

} // namespace

TEST_CASE("64 links of 16 ports in one pair of hosts all cross") {
    ManyLinks hosts;
    const auto start = std::chrono::steady_clock::now();
    hosts.start_rtm();
    hosts.start_opros();
    for (int i = 0; i < links; ++i)
        REQUIRE(hosts.says("opros", "all ports of number " + std::to_string(i) + " crossed"));
    std::printf("data of all ports both ways %.2f s after the start of the hosts\n",
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    for (const char* host : {"opros", "rtm"}) {
        const long switches = supervisor_switches(hosts.pid(host));
        std::printf("%s: %ld context switches of the supervisors of %d links\n", host, switches, links);
        CHECK(switches <= links * max_switches_per_link);
    }
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.output("opros").find("wrong value") == std::string::npos);
    CHECK(hosts.segments().size() == links);
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

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
    CHECK(memory <= ports_per_link * max_memory_per_port);
    CHECK(hosts.stop_both());
}

// Sanitizers keep what was freed, and a copy of each state.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE(
    "each idle port of a link takes at most 72 KiB of each host, including its part of the shared memory") {
    auto with_one = memory_with_idle_links(1), with_all = memory_with_idle_links(links);
    for (const char* host : {"opros", "rtm"}) {
        const auto per_port = (with_all[host] - with_one[host]) / ((links - 1) * ports_per_link);
        std::printf("%s: %ju KiB for each idle port\n", host, per_port / 1024);
        CHECK(with_one[host] > 0);
        CHECK(with_all[host] > with_one[host]);
        CHECK(per_port <= 72 * 1024);
    }
}
#endif

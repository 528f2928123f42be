// SPDX-License-Identifier: Apache-2.0
// No thread of two hosts wakes up while all components wait, and every later event is noticed.
#include "two_hosts.hpp"

#include "tests/support/context_switches.hpp"
#include "tests/support/own_namespaces.hpp"
#include "tests/support/stress.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <thread>

#include <algorithm>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace std::chrono_literals;
using tandem::test::count_context_switches;

/// Gives this process, and the hosts that it starts, a network and a folder for the manager's socket that no other test has: each
/// `tandem rtm` of another test that looks for managers would wake the threads of the end points of rtm_host up to 20 times
/// (omniORB looks at them every 50 ms for a second after a connection). Where the system does not permit a network, the test
/// shares it with the others.
void hide_from_other_tests(const std::filesystem::path& folder) {
    setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
    if (!tandem::test::enter_own_namespaces(CLONE_NEWNET)) return;
    ifreq loopback{};
    std::strcpy(loopback.ifr_name, "lo");
    loopback.ifr_flags = IFF_UP;
    const int any_socket = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    REQUIRE(ioctl(any_socket, SIOCSIFFLAGS, &loopback) == 0);
    close(any_socket);
}

/// WaitComp and WaitRtc, joined in both directions. The RTC's execution context ticks when somebody asks it to.
struct WaitingHosts : TwoHosts {
    WaitingHosts() {
        hide_from_other_tests(folder());
        set_talker("");
        set_rtc("WaitRtc");
        set_rtc_properties("execution_contexts=SynchExtTriggerEC");
        REQUIRE(mkfifo(pipe().c_str(), 0600) == 0);
        add_component("Waiter", "WaitComp", property("pipe", pipe()));
        set_connections(connection("data", "Adaptor", "reply", "Waiter", "reply") +
                        connection("service", "Waiter", "dictionary", "Adaptor", "dictionary"));
    }
    std::string pipe() const { return (folder() / "pipe").string(); }

    /// Has WaitComp ask WaitRtc about a word.
    void ask(const std::string& word) const { std::ofstream(pipe()) << word << std::endl; }
    /// Returns whether it has received both the reply and, through its input port, the word.
    bool is_answered(const std::string& word) const {
        return says("opros", "pages: 5 of " + word + "\n") && says("opros", "reply: " + word + "\n");
    }

    /// Per thread of both hosts, the context switches within that time.
    std::map<std::string, long> switches_within(std::chrono::milliseconds time) const {
        std::map<std::string, long> before, difference;
        for (const char* host : {"opros", "rtm"})
            for (const auto& [thread, count] : count_context_switches(pid(host)))
                before[fmt::format("{} {}", host, thread)] = count;
        std::this_thread::sleep_for(time);
        for (const char* host : {"opros", "rtm"})
            for (const auto& [thread, count] : count_context_switches(pid(host)))
                if (const long more = count - before[fmt::format("{} {}", host, thread)]; more != 0)
                    difference[fmt::format("{} {}", host, thread)] = more;
        return difference;
    }
    /// Waits up to 30 s for a second without context switches. Returns those of the last second.
    std::map<std::string, long> switches_when_settled() const {
        std::map<std::string, long> switches;
        for (int second = 0; second < 30; ++second)
            if (switches = switches_within(1s); switches.empty()) break;
        return switches;
    }
};

std::string text_of(const std::map<std::string, long>& switches) {
    std::string text;
    for (const auto& [thread, count] : switches) text += fmt::format("{}: {}\n", thread, count);
    return text;
}

long sum_of(const std::map<std::string, long>& switches) {
    long sum = 0;
    for (const auto& [thread, count] : switches) sum += count;
    return sum;
}

/// 3 s, with TANDEM_STRESS=20 and more 60 s.
std::chrono::seconds observed_time() { return std::chrono::seconds(tandem::test::stress(3, 60)); }

// No thread of Tandem wakes up. The system may cause some wake-ups: a signal, a reclaimed page, a debugger. The slowest timer that
// would be a fault is one of a second.
constexpr long max_switches = 2;

} // namespace

TEST_CASE("idle hosts are not woken, and notice a call, a message, a death and a restart") {
    WaitingHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "ready"));
    const auto check_idle = [&] {
        CHECK(text_of(hosts.switches_when_settled()).empty());
        const auto time = observed_time();
        const auto switches = hosts.switches_within(time);
        UNSCOPED_INFO(text_of(switches));
        CHECK(sum_of(switches) <= max_switches);
        std::printf("%ld context switches of both hosts within %ld s\n", sum_of(switches),
                    static_cast<long>(time.count()));
    };
    check_idle();
    hosts.ask("alpha");
    CHECK(hosts.is_answered("alpha"));
    check_idle();

    hosts.kill("rtm");
    REQUIRE(hosts.says("opros", "is down: the peer process has gone"));
    hosts.ask("beta");
    CHECK(hosts.says("opros", "not ready: the peer is not connected for beta\n"));
    const std::size_t killed = hosts.output("rtm").size();
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready", killed));
    check_idle();
    hosts.ask("gamma");
    CHECK(hosts.is_answered("gamma"));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a call to a stopped idle host ends at its deadline, and the next call is answered") {
    WaitingHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "ready"));
    hosts.ask("alpha");
    REQUIRE(hosts.is_answered("alpha"));
    hosts.pause("rtm");
    hosts.ask("beta");
    CHECK(hosts.says("opros", "refused: "));
    CHECK(hosts.output("opros").find("is down") == std::string::npos);
    hosts.resume("rtm");
    hosts.ask("gamma");
    CHECK(hosts.is_answered("gamma"));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.stop_both());
}

TEST_CASE("an RTC's message wakes the OPRoS component that waits for it, but no thread of the link") {
    WaitingHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "ready"));
    const auto switches_of_notifier = [&] {
        long sum = 0;
        for (const auto& [thread, count] : count_context_switches(hosts.pid("opros")))
            if (thread.starts_with("tandem-arrivals")) sum += count;
        return sum;
    };
    const auto check = [&](const std::string& words) {
        // The first message finds the link's thread, from which the component's takes the doorbell.
        for (int i = 0; i < 3; ++i) {
            hosts.ask(fmt::format("{}-before{}", words, i));
            REQUIRE(hosts.is_answered(fmt::format("{}-before{}", words, i)));
        }
        CHECK(text_of(hosts.switches_when_settled()).empty());
        const long before = switches_of_notifier();
        CHECK(before > 0); // there is one
        for (int i = 0; i < 20; ++i) {
            hosts.ask(fmt::format("{}{}", words, i));
            REQUIRE(hosts.is_answered(fmt::format("{}{}", words, i)));
        }
        CHECK(switches_of_notifier() == before);
    };
    check("first");
    hosts.kill("rtm");
    REQUIRE(hosts.says("opros", "is down: the peer process has gone"));
    const std::size_t killed = hosts.output("rtm").size();
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready", killed));
    check("second");
    CHECK(hosts.stop_both());
}

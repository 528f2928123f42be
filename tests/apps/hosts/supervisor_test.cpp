// SPDX-License-Identifier: Apache-2.0
// The supervisor with shell commands in place of hosts.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>

#include "apps/hosts/supervisor.hpp"
#include "tests/apps/wheelchair/scratch_dir.hpp"

using namespace tandem::hosts;
using namespace std::chrono_literals;

namespace {

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

bool alive(pid_t pid) { return kill(pid, 0) == 0; }

/// Watches until the host's end is reported, at most ten seconds.
bool end_is_reported(Supervisor& s, const Host& host) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < deadline) // a closed pipe ends a wait at once
        for (const Host* h : s.watch(100ms).ended)
            if (h == &host) return true;
    return false;
}

} // namespace

TEST_CASE("a host is ready when it has written `ready`, and is stopped by a signal that it can handle") {
    const ScratchDir dir;
    Supervisor s;
    Host& host =
        s.start({"host", shell("trap 'exit 0' TERM; echo starting; echo ready; while :; do sleep 0.05; done"),
                 dir / "log"});
    s.wait_until_ready(10);
    CHECK(host.ready());
    const pid_t pid = host.process.pid();
    CHECK(s.stop(host));
    CHECK_FALSE(alive(pid));
}

TEST_CASE("a host that ends before it is ready is reported with its log") {
    const ScratchDir dir;
    Supervisor s;
    s.start({"host", shell("echo first >&2; echo 'no such profile' >&2; exit 3"), dir / "log"});
    CHECK_THROWS_WITH(s.wait_until_ready(10),
                      Catch::Contains("exited with 3 before it was ready: no such profile"));
}

TEST_CASE("the wait for a host that never becomes ready ends with its timeout") {
    const ScratchDir dir;
    Supervisor s;
    s.start({"host", shell("exec sleep 100"), dir / "log"});
    CHECK_THROWS_WITH(s.wait_until_ready(0.2),
                      Catch::Contains("was not ready within 0.2 s") && Catch::Contains("--host-wait"));
}

TEST_CASE("a killed host is reported with its signal, and can be started again") {
    const ScratchDir dir;
    Supervisor s;
    Host& host = s.start({"host", shell("echo ready; exec sleep 100"), dir / "log"});
    s.wait_until_ready(10);
    kill(host.process.pid(), SIGKILL);
    REQUIRE(end_is_reported(s, host));
    CHECK(host.process.poll()->text() == "was killed by signal 9 (Killed)");
    CHECK_FALSE(s.stop(host));
    s.restart(host);
    CHECK_FALSE(host.ready());
    s.wait_until_ready(10);
    CHECK(host.ready());
}

TEST_CASE("a host that dies once is restarted at once, and one that keeps dying waits longer each time") {
    const ScratchDir dir;
    Supervisor s;
    Host& host = s.start({"host", shell("echo ready; exit 1"), dir / "log"});
    bool ended = end_is_reported(s, host);
    for (const auto wait : {0ms, 100ms, 200ms, 400ms}) {
        REQUIRE(ended);
        CHECK(s.restart(host) == wait);
        CHECK(host.waits_for_restart());
        CHECK_FALSE(host.running());
        CHECK_FALSE(host.ready());
        bool restarted = false;
        ended = false;
        // The end of a quick host may be reported together with its restart.
        for (const auto deadline = std::chrono::steady_clock::now() + 60s;
             !(restarted && ended) && std::chrono::steady_clock::now() < deadline;) {
            const auto events = s.watch(100ms);
            restarted |= std::count(events.restarted.begin(), events.restarted.end(), &host) > 0;
            ended |= restarted && std::count(events.ended.begin(), events.ended.end(), &host) > 0;
        }
        REQUIRE(restarted);
        CHECK_FALSE(host.waits_for_restart());
    }
    CHECK(host.quick_ends == 4);
    // Pretends that it has run for a long time.
    REQUIRE(ended);
    host.started_at -= 60;
    CHECK(s.restart(host) == 0ms);
    // Pretends that it ended hours ago.
    REQUIRE(end_is_reported(s, host));
    host.quick_ends = 1000;
    CHECK(s.restart(host) == 10s);
}

TEST_CASE("a host that cannot be restarted is reported and tried again, and the others keep running") {
    const ScratchDir dir;
    Supervisor s;
    Host& other = s.start({"other", shell("exec sleep 100"), ""});
    Host& host = s.start({"host", shell("exit 1"), ""});
    REQUIRE(end_is_reported(s, host));
    host.log = (dir / "missing" / "log").string(); // a log that cannot be opened
    s.restart(host);
    std::vector<std::string> reasons;
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (reasons.size() < 2 && std::chrono::steady_clock::now() < deadline)
        for (const auto& [failed, reason] : s.watch(100ms).failed_restarts)
            if (failed == &host) reasons.push_back(reason);
    REQUIRE(reasons.size() >= 2);
    CHECK_THAT(reasons.front(), Catch::Contains("missing/log"));
    CHECK(host.waits_for_restart());
    CHECK(other.running());
    host.log.clear();
    bool restarted = false;
    while (!restarted && std::chrono::steady_clock::now() < deadline)
        for (const Host* again : s.watch(100ms).restarted) restarted = again == &host;
    CHECK(restarted);
}

TEST_CASE("a host that waits for its restart is not started once the hosts are stopped") {
    const ScratchDir dir;
    Supervisor s;
    Host& host =
        s.start({"host", shell("echo started >> " + (dir / "seen").string() + "; exit 1"), dir / "log"});
    REQUIRE(end_is_reported(s, host));
    host.quick_ends = 1;
    CHECK(s.restart(host) == 100ms);
    CHECK_FALSE(s.stop_all(1s, [](const Supervisor::Events&) {}));
    CHECK_FALSE(host.waits_for_restart());
    CHECK(s.watch(300ms).restarted.empty());
    std::ifstream seen(dir / "seen");
    CHECK(std::count(std::istreambuf_iterator<char>(seen), {}, '\n') == 1);
}

TEST_CASE("a restarted host gets its additional arguments once per start") {
    const ScratchDir dir;
    Supervisor s;
    HostCommand command{
        "host", shell("echo \"$0 $#\" >> " + (dir / "seen").string() + "; echo ready; exec sleep 100"),
        dir / "log"};
    command.restart_arguments = {"--again"};
    Host& host = s.start(command);
    s.wait_until_ready(10);
    for (int restart = 0; restart < 2; ++restart) {
        kill(host.process.pid(), SIGKILL);
        REQUIRE(end_is_reported(s, host));
        s.restart(host);
        s.wait_until_ready(10);
    }
    std::ifstream seen(dir / "seen");
    std::string first, second, third;
    std::getline(seen, first);
    std::getline(seen, second);
    std::getline(seen, third);
    CHECK(first.find("--again") == first.npos);
    CHECK(second == "--again 0");
    CHECK(third == "--again 0");
}

TEST_CASE("hosts do not outlive their supervisor") {
    const ScratchDir dir;
    pid_t pid = 0;
    {
        Supervisor s;
        pid = s.start({"host", shell("echo ready; exec sleep 100"), dir / "log"}).process.pid();
        s.wait_until_ready(10);
    }
    CHECK_FALSE(alive(pid));
}

TEST_CASE("an interrupt of this program is reported and ends the wait for a host") {
    const ScratchDir dir;
    Supervisor s;
    s.start({"host", shell("exec sleep 100"), dir / "log"});
    raise(SIGINT);
    CHECK_THROWS_AS(s.wait_until_ready(10), Interrupted);
}

TEST_CASE("a program that does not exist is named") {
    const ScratchDir dir;
    Supervisor s;
    CHECK_THROWS_WITH(s.start({"host", {"/nonexistent/host"}, dir / "log"}),
                      Catch::Contains("/nonexistent/host cannot be started: No such file"));
}

TEST_CASE("the printed command line can be typed into a shell") {
    const ScratchDir dir;
    Supervisor s;
    Host& host = s.start({"host", shell("echo ready; exec sleep 100"), dir / "log"});
    CHECK(host.command_line() == "/bin/sh -c 'echo ready; exec sleep 100'");
    host.command = {"host", "--parent-death", "it's"};
    CHECK(host.command_line() == "host 'it'\\''s'");
}

TEST_CASE("the output and errors of a host without a log arrive line by line, including the last line") {
    Supervisor s;
    Host& host =
        s.start({"host", shell("echo one; echo two >&2; echo ready; pwd; printf end; exit 2"), "", "/usr"});
    std::vector<std::string> lines;
    while (host.running())
        for (const auto& [of, line] : s.watch(100ms).lines) lines.push_back(line);
    CHECK(lines == std::vector<std::string>{"one", "two", "ready", "/usr", "end"});
    CHECK(host.first_error() == "end");
}

TEST_CASE("hosts stopped together are read while they stop, and killed if they do not end in time") {
    Supervisor s;
    // More than a pipe holds.
    s.start(
        {"writer",
         shell(
             "trap 'head -c 300000 /dev/zero | tr \\\\0 x; echo; exit 0' TERM; echo ready; while :; do sleep "
             "0.05; done"),
         ""});
    s.start({"deaf", shell("trap '' TERM; echo ready; while :; do sleep 0.05; done"), ""});
    for (int ready = 0; ready < 2;) ready += static_cast<int>(s.watch(100ms).became_ready.size());
    std::size_t bytes = 0;
    const bool in_order = s.stop_all(2s, [&](const Supervisor::Events& events) {
        for (const auto& [host, line] : events.lines) bytes += line.size();
    });
    CHECK_FALSE(in_order);
    CHECK(bytes == 300000);
    CHECK(s.hosts()[0].process.poll()->text() == "exited with 0");
    CHECK(s.hosts()[1].process.poll()->text() == "was killed by signal 9 (Killed)");
}

TEST_CASE("a signal that arrives twice at once leaves the hosts time to end normally") {
    Supervisor s;
    s.start({"slow", shell("trap 'sleep 0.3; exit 0' TERM; echo ready; while :; do sleep 0.05; done"), ""});
    while (s.watch(100ms).became_ready.empty()) {
    }
    raise(SIGTERM);
    CHECK(s.watch(100ms).interrupted);
    bool again = false;
    CHECK(s.stop_all(60s, [&](const Supervisor::Events&) {
        if (!std::exchange(again, true)) raise(SIGTERM);
    }));
    CHECK(s.hosts()[0].process.poll()->text() == "exited with 0");
}

TEST_CASE("a later signal kills hosts that do not end") {
    Supervisor s;
    s.start({"deaf", shell("trap '' TERM; echo ready; while :; do sleep 0.05; done"), ""});
    while (s.watch(100ms).became_ready.empty()) {
    }
    CHECK_FALSE(s.stop_all(600s, [](const Supervisor::Events& events) {
        if (events.ended.empty()) raise(SIGINT); // one after the end would be this program's own
    }));
    CHECK(s.hosts()[0].process.poll()->text() == "was killed by signal 9 (Killed)");
}

TEST_CASE("a prompt is shown without its newline, and does not hide that the host is ready") {
    Supervisor s;
    Host& host = s.start(
        {"host", shell("printf 'number: '; printf '\\nready\\n'; printf 'again: '; exec sleep 100"), "", ""});
    std::vector<std::string> lines;
    while (lines.size() < 3)
        for (const auto& [of, line] : s.watch(100ms).lines) lines.push_back(line);
    CHECK(host.ready());
    CHECK(lines == std::vector<std::string>{"number: ", "ready", "again: "});
}

TEST_CASE("each host, including a restarted one, reads this program's input to its end") {
    std::array<int, 2> input{};
    REQUIRE(pipe2(input.data(), O_CLOEXEC) == 0);
    Supervisor s;
    s.relay_input(input[0]);
    const std::string script = "read line; echo \"got $line\"; while read line; do :; done; echo over";
    s.start({"first", shell(script), "", ""});
    Host& second = s.start({"second", shell("read line; echo \"and $line\""), "", ""});
    REQUIRE(write(input[1], "one\n", 4) == 4);
    std::multiset<std::string> lines;
    const auto watch_until = [&](const std::string& line) {
        while (lines.count(line) == 0)
            for (const auto& [of, text] : s.watch(100ms).lines) lines.insert(text);
    };
    watch_until("got one");
    watch_until("and one");
    while (second.running()) s.watch(100ms);
    s.restart(second);
    REQUIRE(write(input[1], "two\n", 4) == 4);
    watch_until("and two");
    close(input[1]);
    watch_until("over");
    close(input[0]);
}

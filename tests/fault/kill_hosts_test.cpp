// SPDX-License-Identifier: Apache-2.0
// Two hosts under data, event and call load from both sides. Again and again, one of them is killed at a random moment.
#include "tests/integration/two_hosts.hpp"

#include "kept_segment.hpp"
#include "load/load_counts.h"
#include "tests/shm/fixture.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// The file in which both components count.
class CountsFile {
  public:
    explicit CountsFile(const std::filesystem::path& folder) : path_((folder / "counts").string()) {
        std::ofstream(path_) << std::string(sizeof(LoadCounts), '\0');
        setenv("TANDEM_LOAD_COUNTS", path_.c_str(), 1);
        const tandem::process::FileDescriptor file(open(path_.c_str(), O_RDWR | O_CLOEXEC));
        memory_ = mmap(nullptr, sizeof(LoadCounts), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
        if (memory_ == MAP_FAILED) throw std::runtime_error("cannot map " + path_);
    }
    ~CountsFile() { munmap(memory_, sizeof(LoadCounts)); }
    CountsFile(const CountsFile&) = delete;
    CountsFile& operator=(const CountsFile&) = delete;
    LoadCounts& operator*() const { return *static_cast<LoadCounts*>(memory_); }

  private:
    std::string path_;
    void* memory_;
};

/// LoadComp and LoadRtc, joined by all their ports.
class LoadedHosts : public TwoHosts {
  public:
    LoadedHosts() : counts_(folder()) {
        std::filesystem::copy_file(LOAD_SOURCES "/LoadComp.xml", folder() / "LoadComp.xml");
        set_talker("LoadComp");
        set_rtc("LoadRtc");
        set_interceptor("rtc=LoadRtc0&call_timeout=" + std::to_string(call_deadline_ms));
        set_adaptor_properties(property("call_timeout", std::to_string(call_deadline_ms)) +
                               property("event_ports", "raised, answer"));
        set_connections(connection("data", "Talker", "out", "Adaptor", "numbers") +
                        connection("data", "Adaptor", "back", "Talker", "in") +
                        connection("event", "Talker", "alarm", "Adaptor", "raised") +
                        connection("event", "Adaptor", "answer", "Talker", "notice") +
                        connection("service", "Talker", "worker", "Adaptor", "worker") +
                        connection("service", "Adaptor", "work", "Talker", "work"));
    }
    void start(const std::string& host) { host == "opros" ? start_opros() : start_rtm(); }
    SideCounts& counts(const std::string& host) const {
        return host == "opros" ? (*counts_).opros : (*counts_).rtm;
    }

    /// Returns whether both sides have received messages of the other's present life.
    bool flows() const {
        const auto &opros = counts("opros"), &rtm = counts("rtm");
        return opros.first_received_ns != 0 && rtm.first_received_ns != 0 && opros.peer_life == rtm.lives &&
               rtm.peer_life == opros.lives;
    }
    /// Messages, events and calls that have gone through, both ways.
    std::vector<std::uint64_t> crossed() const {
        std::vector<std::uint64_t> all;
        for (const char* host : {"opros", "rtm"}) {
            const auto& side = counts(host);
            all.insert(all.end(),
                       {side.received, side.events_received, side.ended[static_cast<int>(CallEnd::ok)]});
        }
        return all;
    }
    /// When the calls under way of both sides began; 0 where there is none.
    std::vector<std::uint64_t> calls_under_way() const {
        std::vector<std::uint64_t> all;
        for (const char* host : {"opros", "rtm"})
            for (const auto& begun : counts(host).begun_ns) all.push_back(begun);
        return all;
    }
    /// The age of that side's oldest call under way, in ms.
    std::uint64_t longest_call_ms(const std::string& host) const {
        std::uint64_t longest = 0;
        const std::uint64_t now = load_clock_ns();
        for (const auto& call : counts(host).begun_ns)
            if (const std::uint64_t begun = call; begun != 0 && begun < now)
                longest = std::max(longest, now - begun);
        return longest / 1'000'000;
    }

  private:
    CountsFile counts_;
};

/// A thread that wakes every millisecond. Its lateness shows how long the machine did not run this process.
class StallWatch {
  public:
    StallWatch()
        : thread_([this] {
              for (auto due = std::chrono::steady_clock::now(); !stopping_;) {
                  due += 1ms;
                  std::this_thread::sleep_until(due);
                  const auto now = std::chrono::steady_clock::now();
                  longest_ns_ = std::max<std::int64_t>(longest_ns_, (now - due).count());
                  due = now;
              }
          }) {}
    ~StallWatch() {
        stopping_ = true;
        thread_.join();
    }
    StallWatch(const StallWatch&) = delete;
    StallWatch& operator=(const StallWatch&) = delete;
    /// The longest stall since the last call.
    double take_ms() { return static_cast<double>(longest_ns_.exchange(0)) / 1e6; }

  private:
    std::atomic<bool> stopping_{false};
    std::atomic<std::int64_t> longest_ns_{0};
    std::thread thread_;
};

std::string other(const std::string& host) { return host == "opros" ? "rtm" : "opros"; }

/// What became of the sent messages, over all generations that the death of one host ended.
struct Balance {
    std::uint64_t sent = 0, received = 0, dropped = 0, untaken = 0, generations = 0;
    std::vector<std::string> faults;

    /// A killed process may have counted one message less than it had sent or taken.
    void add(KeptSegment& segment, const std::string& victim) {
        ++generations;
        for (const auto& ring : segment.rings()) {
            const auto& counters = ring.counters;
            sent += counters.sent;
            received += counters.received;
            dropped += counters.dropped();
            untaken += ring.untaken;
            const auto gone =
                static_cast<std::int64_t>(counters.received + counters.dropped() + ring.untaken);
            const std::int64_t lost = static_cast<std::int64_t>(counters.sent) - gone;
            const bool writer_died = (ring.writer == Side::first) == (victim == "opros");
            if (writer_died ? lost == 0 || lost == -1 : lost == 0 || lost == 1) continue;
            std::ostringstream text;
            text << "generation " << segment.generation() << ", " << victim << " killed, ring '" << ring.name
                 << "': sent " << counters.sent << ", received " << counters.received << ", dropped "
                 << counters.dropped() << ", untaken " << ring.untaken;
            faults.push_back(text.str());
        }
    }
};

double quantile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values.at(static_cast<std::size_t>(q * static_cast<double>(values.size() - 1)));
}

void print_times(const char* what, const std::vector<double>& ms) {
    if (ms.empty()) return;
    std::printf("%s: median %.1f ms, p90 %.1f ms, p99 %.1f ms, at most %.1f ms\n", what, quantile(ms, 0.5),
                quantile(ms, 0.9), quantile(ms, 0.99), quantile(ms, 1));
}

void print_calls(const char* host, const SideCounts& side) {
    std::uint64_t all = 0, late = 0;
    for (const auto& end : side.ended) all += end;
    for (const auto& calls : side.overtime) late += calls;
    const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
    std::printf(
        "%s: %llu lives, sent %llu messages, received %llu, %llu wrong; sent %llu events, received %llu\n"
        "%s: %llu calls ended: %llu ok, %llu not ready, %llu timeout, %llu peer died, %llu overload, %llu "
        "other; %llu after the deadline, %llu of them more than 20 ms, the last by %.1f ms\n",
        host, number(side.lives), number(side.sent), number(side.received), number(side.wrong),
        number(side.events_sent), number(side.events_received), host, number(all), number(side.ended[0]),
        number(side.ended[1]), number(side.ended[2]), number(side.ended[3]), number(side.ended[4]),
        number(side.ended[5]), number(late), number(side.over_20_ms()),
        static_cast<double>(side.longest_overtime_ns) / 1e6);
}

double ms_between(std::uint64_t from, std::uint64_t to) {
    return to > from ? static_cast<double>(to - from) / 1e6 : 0;
}

} // namespace

TEST_CASE(
    "a host killed at any moment under data, events and calls ends no call without an error and comes back") {
    std::mt19937 random(1512 + Catch::rngSeed()); // --rng-seed N: other moments
    const auto up_to_ms = [&](unsigned ms) {
        std::this_thread::sleep_for(std::chrono::microseconds(random() % (1000 * ms)));
    };
    LoadedHosts hosts;
    hosts.start("rtm");
    hosts.start("opros");
    REQUIRE(eventually([&] { return hosts.flows(); }, 60s));
    Balance balance;
    std::map<std::string, std::vector<double>> since_start; ///< by the host that was killed
    std::vector<double> since_ready;
    const std::size_t rounds = stress(5, 1000);
    StallWatch stalls;
    const auto late_calls = [&] {
        return hosts.counts("opros").over_20_ms() + hosts.counts("rtm").over_20_ms();
    };
    std::size_t kills = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
        const std::string victim = random() % 2 == 0 ? "opros" : "rtm", survivor = other(victim);
        const std::uint64_t late = late_calls();
        up_to_ms(200);
        CAPTURE(round, victim);
        KeptSegment segment(hosts.link());
        REQUIRE(segment);
        hosts.kill(victim);
        ++kills;
        if (random() % 4 == 0) { // whatever it is doing: loading, joining, connecting
            hosts.start(victim);
            up_to_ms(400);
            hosts.kill(victim);
            ++kills;
        }
        const double stall_before_ms = stalls.take_ms();
        const std::uint64_t started = load_clock_ns();
        hosts.counts(victim).first_received_ns = 0;
        hosts.start(victim);
        std::uint64_t longest_call = 0;
        const bool flows = eventually(
            [&] {
                longest_call = std::max(longest_call, hosts.longest_call_ms(survivor));
                return hosts.counts(victim).ready_ns > started && hosts.flows();
            },
            60s);
        INFO(hosts.output("opros").substr(hosts.output("opros").size() -
                                          std::min<std::size_t>(hosts.output("opros").size(), 3000)));
        INFO(hosts.output("rtm").substr(hosts.output("rtm").size() -
                                        std::min<std::size_t>(hosts.output("rtm").size(), 3000)));
        REQUIRE(flows);
        REQUIRE(hosts.runs(survivor));
        CHECK(longest_call < call_deadline_ms + 10'000); // a call that hangs, not one that is late
        const auto before = hosts.crossed();
        REQUIRE(eventually(
            [&] {
                const auto now = hosts.crossed();
                return std::equal(now.begin(), now.end(), before.begin(), std::greater<>());
            },
            60s));
        const auto calls = hosts.calls_under_way();
        REQUIRE(eventually( // no call that was under way still waits
            [&] {
                const auto now = hosts.calls_under_way();
                for (std::size_t i = 0; i < calls.size(); ++i)
                    if (calls[i] != 0 && now[i] == calls[i]) return false;
                return true;
            },
            60s));
        balance.add(segment, victim);
        const std::uint64_t again = std::max<std::uint64_t>(hosts.counts(victim).first_received_ns,
                                                            hosts.counts(survivor).first_of_peer_life_ns);
        since_start[victim].push_back(ms_between(started, again));
        since_ready.push_back(ms_between(hosts.counts(victim).ready_ns, again));
        const double stall_ms = stalls.take_ms();
        if (since_start[victim].back() > 100 || late_calls() != late)
            std::printf("round %zu: %s was back after %.1f ms, %llu calls more than 20 ms late; the "
                        "machine's longest stall "
                        "was %.1f ms before its start and %.1f ms after it\n",
                        round, victim.c_str(), since_start[victim].back(),
                        static_cast<unsigned long long>(late_calls() - late), stall_before_ms, stall_ms);
    }
    std::printf("%zu kills in %zu rounds\n", kills, rounds);
    print_calls("opros", hosts.counts("opros"));
    print_calls("rtm", hosts.counts("rtm"));
    std::printf(
        "%llu generations: sent %llu = received %llu + dropped %llu + not taken when one side died %llu\n",
        static_cast<unsigned long long>(balance.generations), static_cast<unsigned long long>(balance.sent),
        static_cast<unsigned long long>(balance.received), static_cast<unsigned long long>(balance.dropped),
        static_cast<unsigned long long>(balance.untaken));
    for (const auto& [host, ms] : since_start)
        print_times(("data both ways after the start of the process of " + host).c_str(), ms);
    print_times("data both ways after its component was there", since_ready);
    for (const auto& fault : balance.faults) FAIL_CHECK(fault);
    for (const char* host : {"opros", "rtm"}) {
        INFO(host);
        CHECK(hosts.counts(host).wrong == 0);
        CHECK(hosts.counts(host).ended[static_cast<int>(CallEnd::other)] == 0);
    }
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

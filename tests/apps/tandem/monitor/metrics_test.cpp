// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/metrics.hpp"
#include "pattern.hpp"
#include "states.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <sstream>

using namespace tandem::monitor;
using namespace tandem::monitor::test;

namespace {

/// Checks the text against the rules of OpenMetrics 1.0.0 that apply to it. Returns the samples by name and labels.
std::map<std::string, std::string> parse(const std::string& text) {
    REQUIRE(text.size() > 6);
    CHECK(text.substr(text.size() - 6) == "# EOF\n");
    static const Pattern metadata("^# (TYPE|UNIT|HELP) ([a-z_]+) (.*)$");
    static const Pattern sample(
        R"(^([a-z_]+)(\{[a-z]+="([^"\\]|\\["\\n])*"(,[a-z]+="([^"\\]|\\["\\n])*")*\}) ([0-9.e+-]+)$)");
    std::map<std::string, std::string> samples;
    std::set<std::string> families;
    std::string family, type, line;
    std::istringstream lines(text);
    while (std::getline(lines, line) && line != "# EOF") {
        INFO(line);
        if (const auto match = metadata.match(line); !match.empty()) {
            if (match[1] == "TYPE") {
                family = match[2];
                type = match[3];
                CHECK(families.insert(family).second); // a family is in one place
            }
            CHECK(match[2] == family);
            if (match[1] == "UNIT") CHECK_THAT(family, Catch::EndsWith("_" + match[3]));
            continue;
        }
        const auto match = sample.match(line);
        REQUIRE(!match.empty());
        const std::string suffix = type == "counter" ? "_total" : type == "histogram" ? "_bucket" : "";
        CHECK(match[1] == family + suffix);
        CHECK(samples.emplace(match[1] + match[2], match[6]).second); // no series twice
    }
    CHECK_FALSE(std::getline(lines, line));
    return samples;
}

} // namespace

TEST_CASE("the metrics of a link are valid OpenMetrics with all counters") {
    LinkState link = sound_link();
    auto& port = link.ports[0];
    port.counters = {10, 1, 2, 3, 4, 500, 600, 7, 8, 9};
    port.age.counts[tandem::shm::layout::Histogram::bucket_of(2000)] = 5;
    port.age.counts[tandem::shm::layout::Histogram::bucket_of(100)] = 1;
    auto& queue = link.call_queues[0].counters;
    queue.calls = 40;
    queue.timeouts = 2;
    link.call_queues[0].open_calls = 3;
    const auto samples = parse(metrics_text(state_of({link, sound_link("other")})));
    const std::string labels = R"(link="chair",port="velocity",owner="second",writer="first")";
    const auto of_port = [&](const std::string& name, const std::string& more = "") {
        return samples.at("tandem_port_" + name + "{" + labels + more + "}");
    };
    CHECK(of_port("sent_messages_total") == "10");
    CHECK(of_port("dropped_messages_total", R"(,kind="refused")") == "1");
    CHECK(of_port("dropped_messages_total", R"(,kind="overwritten")") == "2");
    CHECK(of_port("dropped_messages_total", R"(,kind="skipped")") == "3");
    CHECK(of_port("received_messages_total") == "4");
    CHECK(of_port("sent_bytes_total") == "500");
    CHECK(of_port("converted_messages_total") == "7");
    CHECK(of_port("undecodable_messages_total") == "8");
    CHECK(of_port("missed_deadlines_total") == "9");
    CHECK(of_port("age_seconds_bucket", R"(,le="1.024e-06")") == "1");
    CHECK(of_port("age_seconds_bucket", R"(,le="4.096e-06")") == "6");
    CHECK(of_port("age_seconds_bucket", R"(,le="+Inf")") == "6");
    const std::string calls = R"({link="chair",queue="calls",owner="first",callers="second"})";
    CHECK(samples.at("tandem_calls_made_total" + calls) == "40");
    CHECK(samples.at("tandem_calls_timed_out_total" + calls) == "2");
    CHECK(samples.at("tandem_calls_open" + calls) == "3");
    CHECK(samples.at(R"(tandem_side_up{link="chair",side="first",model="OPRoS"})") == "1");
}

TEST_CASE("metrics of names with quotes are escaped") {
    LinkState link = sound_link();
    link.ports[0].name = R"(a"b\c)";
    const auto text = metrics_text(state_of({link}));
    parse(text);
    CHECK_THAT(text, Catch::Contains(R"(port="a\"b\\c")"));
}

TEST_CASE("metrics omit unreadable links, and are valid without a link") {
    parse(metrics_text(state_of({})));
    LinkState damaged = sound_link(), unreadable = sound_link("hidden");
    damaged.ports[0].damage = "no ring";
    unreadable.readable = false;
    unreadable.ports.clear();
    unreadable.call_queues.clear();
    unreadable.sides[0] = unreadable.sides[1] = {};
    const auto text = metrics_text(state_of({damaged, unreadable}));
    parse(text);
    CHECK_THAT(text, !Catch::Contains("velocity") && !Catch::Contains("hidden"));
}

TEST_CASE("a side that is dead or stopped is not up") {
    LinkState link = sound_link();
    link.sides[0].state = tandem::shm::PeerState::dead;
    link.sides[1].state = tandem::shm::PeerState::stopped;
    const auto samples = parse(metrics_text(state_of({link})));
    CHECK(samples.at(R"(tandem_side_up{link="chair",side="first",model="OPRoS"})") == "0");
    CHECK(samples.at(R"(tandem_side_dead{link="chair",side="first",model="OPRoS"})") == "1");
    CHECK(samples.at(R"(tandem_side_up{link="chair",side="second",model="RTM"})") == "0");
    CHECK(samples.at(R"(tandem_side_dead{link="chair",side="second",model="RTM"})") == "0");
}

TEST_CASE("ticks are metrics, also two with the same name in one process") {
    State state = state_of({sound_link()});
    TickState tick;
    tick.name = "Control";
    tick.program = "rtm_host";
    tick.pid = 22;
    tick.period_ns = 10'000'000;
    tick.ticks = 1000;
    tick.overruns = 7;
    tick.skipped = 3;
    tick.lateness[4] = 900; // 512 ns to 1.024 us
    tick.lateness[5] = 99;
    tick.lateness[31] = 1;
    tick.execution[11] = 1000; // 65.5 us to 131 us
    state.ticks = {tick, tick};
    state.ticks[0].hang = HangState{"Control", "onExecute", 1000, 2.5};
    const auto samples = parse(metrics_text(state));
    const std::string labels = R"(component="Control",host="rtm_host",pid="22",number="2")";
    CHECK(samples.at("tandem_tick_period_seconds{" + labels + "}") == "0.01");
    CHECK(samples.at("tandem_ticks_total{" + labels + "}") == "1000");
    CHECK(samples.at("tandem_tick_overruns_total{" + labels + "}") == "7");
    CHECK(samples.at("tandem_tick_skipped_periods_total{" + labels + "}") == "3");
    CHECK(samples.at("tandem_tick_hang_seconds{" + labels + "}") == "0");
    CHECK(
        samples.at(R"(tandem_tick_hang_seconds{component="Control",host="rtm_host",pid="22",number="1"})") ==
        "2.5");
    const auto bucket = [&](const std::string& le) {
        return samples.at("tandem_tick_lateness_seconds_bucket{" + labels + ",le=\"" + le + "\"}");
    };
    CHECK(bucket("1.024e-06") == "900");
    CHECK(bucket("4.096e-06") == "999");
    CHECK(bucket("17.179869184") == "999");
    CHECK(bucket("+Inf") == "1000");
    CHECK(samples.at("tandem_tick_execution_seconds_bucket{" + labels + ",le=\"6.5536e-05\"}") == "0");
    CHECK(samples.at("tandem_tick_execution_seconds_bucket{" + labels + ",le=\"0.000262144\"}") == "1000");
}

TEST_CASE("the verdict is a metric with one level that is 1, and so are the states of components") {
    using tandem::process::ComponentState;
    State state = state_of({sound_link()});
    state.components = {{"rtm_host", 22, "Arm0", ComponentState::active},
                        {"rtm_host", 22, "Leg0", ComponentState::error}};
    const auto samples = parse(metrics_text(state));
    CHECK(samples.at(R"(tandem_verdict{level="failed"})") == "1");
    CHECK(samples.at(R"(tandem_verdict{level="well"})") == "0");
    CHECK(samples.at(R"(tandem_component_active{component="Arm0",host="rtm_host",pid="22"})") == "1");
    CHECK(samples.at(R"(tandem_component_active{component="Leg0",host="rtm_host",pid="22"})") == "0");
    CHECK(parse(metrics_text(state_of({sound_link()}))).at(R"(tandem_verdict{level="well"})") == "1");
}

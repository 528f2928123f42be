// SPDX-License-Identifier: Apache-2.0
// What the monitor shows of links that run, over its WebSocket and as JSON.
#include "http_client.hpp"

#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"

#include <nlohmann/json.hpp>

using namespace tandem::monitor::test;
using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

std::span<const std::byte> bytes_of_number(const double& value) {
    return std::as_bytes(std::span(&value, 1));
}

/// A host in a separate process that joins a side, publishes its model without ports, and sleeps until it is killed.
Child sleeping_host(const std::string& link, Side side, const std::string& model) {
    Child child([=] {
        const auto segment = Segment::join(link, side, small());
        publish_table(*segment, {{}, {}, model});
        for (;;) std::this_thread::sleep_for(1s);
        return 0;
    });
    return child;
}

/// The first of the next states, at most `most`, with that level; null if there is none.
nlohmann::json next_with(Live& page, const std::string& level, int most) {
    for (int i = 0; i < most; ++i)
        if (auto state = page.next(); state["verdict"]["level"] == level) return state;
    return nullptr;
}

} // namespace

TEST_CASE("a page sees a port's type, counters, rate and newest value") {
    const Pair pair;
    const auto rings = add_ports(*pair.first, {"speed"});
    RingWriter writer(rings[0]);
    const RunningMonitor monitor(pair.link.name);
    Live page(monitor);
    page.send("ignored");
    nlohmann::json port;
    double value = 0;
    REQUIRE(eventually([&] {
        value += 0.5;
        writer.write(bytes_of_number(value), now_ns());
        port = page.next()["links"][0]["ports"][0];
        return port["sent_per_s"] > 0 && !port["value"].is_null();
    }));
    CHECK(port["name"] == "speed");
    CHECK(port["component"] == "Plant");
    CHECK(port["type"] == "Number");
    CHECK(port["writer"] == "first");
    CHECK(port["waiting"] > 0);
    CHECK(port["silent_s"].is_number());
    const auto seen = port["value"].is_array() ? port["value"][0] : port["value"].begin().value();
    CHECK((seen == value || seen == value - 0.5));
    CHECK(state(monitor)["links"][0]["name"] == pair.link.name);
    CHECK(state(monitor)["links"][0]["sides"]["first"]["pid"] == getpid());
    const Answer metrics = get(monitor, "/metrics");
    CHECK(metrics.type == "application/openmetrics-text; version=1.0.0; charset=utf-8");
    CHECK_THAT(metrics.body, Catch::Contains("tandem_port_sent_messages_total{link=\"" + pair.link.name +
                                             "\",port=\"speed\""));
    CHECK_THAT(metrics.body, Catch::EndsWith("# EOF\n"));
}

TEST_CASE("a killed side changes the verdict within two states and is an event") {
    const Link link;
    // The side does not tell the model.
    Child first = sleeping_host(link.name, Side::first, "RTM"),
          second = sleeping_host(link.name, Side::second, "OPRoS");
    const RunningMonitor monitor(link.name);
    Live page(monitor);
    REQUIRE_FALSE(next_with(page, "well", 40).is_null());
    second.kill_now();
    // One may have been under way.
    const auto dead = next_with(page, "dead", 3);
    REQUIRE_FALSE(dead.is_null());
    CHECK_THAT(dead["verdict"]["reason"].get<std::string>(), Catch::Contains("the OPRoS host"));
    CHECK_THAT(dead["events"].back()["text"].get<std::string>(), Catch::Contains("has died"));
    CHECK(dead["events"].back()["bad"] == true);
    first.kill_now();
    for (const auto& file : link.files()) std::filesystem::remove(file);
    const auto gone = next_with(page, "missing", 3);
    REQUIRE_FALSE(gone.is_null());
    CHECK(gone["links"].empty());
}

TEST_CASE("a side whose peer joins the next generation is gone until it returns") {
    const Link link;
    auto first = join(link, Side::first);
    first->publish();
    Child second = sleeping_host(link.name, Side::second, "RTM");
    const RunningMonitor monitor(link.name);
    Live page(monitor);
    REQUIRE_FALSE(next_with(page, "well", 40).is_null());
    const pid_t pid = second.pid();
    second.kill_now();
    first.reset();
    first = join(link, Side::first);
    first->publish();
    nlohmann::json state;
    REQUIRE(
        eventually([&] { return (state = page.next())["links"][0]["sides"]["second"]["state"] == "gone"; }));
    CHECK(state["verdict"]["level"] == "dead");
    const auto& sides = state["links"][0]["sides"];
    CHECK(sides["second"]["pid"] == pid);
    CHECK(sides["second"]["model"] == "RTM");
    CHECK(sides["second"]["ended_in_order"] == false);
    CHECK(sides["first"]["model"] == "unknown"); // it has published no table
    const Child again = sleeping_host(link.name, Side::second, "RTM");
    CHECK_FALSE(next_with(page, "well", 40).is_null());
}

TEST_CASE("a side that leaves cleanly has ended, even when its peer has joined the next generation") {
    const Link link;
    auto first = join(link, Side::first), second = join(link, Side::second);
    first->publish();
    second->publish();
    const RunningMonitor monitor(link.name);
    Live page(monitor);
    REQUIRE_FALSE(next_with(page, "well", 40).is_null());
    second->leave();
    first.reset();
    first = join(link, Side::first);
    first->publish();
    const auto ended = next_with(page, "gone", 5);
    REQUIRE_FALSE(ended.is_null());
    CHECK(ended["links"][0]["sides"]["second"]["ended_in_order"] == true);
    CHECK_THAT(ended["verdict"]["reason"].get<std::string>(), Catch::Contains("has ended cleanly"));
    CHECK_THAT(ended["events"].dump(), Catch::Contains("has ended cleanly") && !Catch::Contains("has died"));
}

TEST_CASE("dropped messages change the verdict, and so does a stopped host") {
    const Link link;
    Child second = sleeping_host(link.name, Side::second, "RTM");
    const auto first = join(link, Side::first);
    const auto rings = add_ports(*first, {"speed"});
    const RunningMonitor monitor(link.name);
    Live page(monitor);
    REQUIRE_FALSE(next_with(page, "well", 40).is_null());
    RingWriter writer(rings[0]);
    for (int i = 0; i < 1000; ++i) writer.write(bytes_of_number(1), now_ns());
    const auto dropping = next_with(page, "dropping", 3);
    REQUIRE_FALSE(dropping.is_null());
    CHECK_THAT(dropping["verdict"]["reason"].get<std::string>(), Catch::Contains("port speed"));
    kill(second.pid(), SIGSTOP);
    CHECK_FALSE(next_with(page, "stopped", 3).is_null());
    kill(second.pid(), SIGCONT);
}

TEST_CASE("a client that does not read skips states, and the others do not wait for it") {
    const Pair pair(small(8 << 20));
    std::vector<std::string> names;
    for (int i = 0; i < 400; ++i) names.push_back("port" + std::to_string(i));
    add_ports(*pair.first, names);
    RunningMonitor monitor(pair.link.name);
    Live slow(monitor, 4096), page(monitor);
    for (int i = 0; i < 20; ++i) CHECK(page.next()["links"][0]["ports"].size() == 400);
    const long peak_kb = monitor.peak_kb();
    std::uint64_t last = 0, longest_gap = 0;
    for (int i = 0; i < 10; ++i) {
        const std::uint64_t time = slow.next()["time_ms"];
        if (last != 0) longest_gap = std::max(longest_gap, time - last);
        last = time;
    }
    CHECK(longest_gap >= 1000); // two states at least were skipped
    CHECK(monitor.peak_kb() < peak_kb + 8192);
    CHECK(monitor.runs());
}

TEST_CASE("damaged segments and invalid messages end neither the monitor nor the page") {
    const Pair pair;
    const auto rings = add_ports(*pair.first, {"text", "list"}, "s");
    pair.second->publish();
    RingWriter writer(rings[0]);
    RunningMonitor monitor(pair.link.name);
    Live page(monitor);
    REQUIRE_FALSE(next_with(page, "well", 40).is_null());
    writer.write(bytes_of("\xff\xff\xff\xff nonsense"), now_ns());
    CHECK(eventually([&] { return page.next()["links"][0]["ports"][0]["value_note"] != ""; }));
    std::ofstream(segment_path(pair.link.name, 9)) << "no segment";
    const auto damaged = next_with(page, "unreadable", 3);
    REQUIRE_FALSE(damaged.is_null());
    CHECK(monitor.runs());
}

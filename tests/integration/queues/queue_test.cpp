// SPDX-License-Identifier: Apache-2.0
// The queue of a receiving port is the port's own, whether a component of its host sends or one across the link.
#include "tests/apps/tandem/program.hpp"
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace {

/// Returns the text after `NAME:` in a host's output.
std::string printed(const TwoHosts& hosts, const std::string& host, const std::string& name) {
    const std::string output = hosts.output(host), begin = "\n" + name + ":";
    const auto at = output.find(begin);
    if (at == std::string::npos) return "nothing";
    const auto from = at + begin.size();
    return output.substr(from, output.find('\n', from) - from);
}

/// The numbers from `first` to `last`, with a blank before each.
std::string numbers(int first, int last) {
    std::string text;
    const int step = first <= last ? 1 : -1;
    for (int i = first; i != last + step; i += step) text += " " + std::to_string(i);
    return text;
}

} // namespace

TEST_CASE("of fifty messages, a port gets the same ones across the link as within a host") {
    TwoHosts hosts;
    hosts.leave_out_talker_and_rtc();
    hosts.set_rtc("QueueRtc");
    hosts.add_rtc("QueueRtc"); // not behind the link
    hosts.add_component("Queue", "QueueComp");
    const std::vector<std::pair<std::string, std::string>> of_rtc{
        {"plain", numbers(43, 50) + ", then 50."}, // OpenRTM's buffer of 8
        {"one", numbers(50, 50) + ", then 50."},
        {"four", numbers(47, 50) + ", then 50."},
        {"four_refusing", numbers(1, 4) + ", then 4."},
        {"four_without_readback", numbers(47, 50) + ", then none."}};
    const std::vector<std::pair<std::string, std::string>> of_component{
        {"sole", numbers(47, 50) + "."},  {"last", numbers(50, 50) + "."}, {"fifo1", numbers(50, 50) + "."},
        {"fifo4", numbers(47, 50) + "."}, {"lifo4", numbers(50, 1) + "."}, {"ufifo4", numbers(1, 50) + "."},
        {"fifo200", numbers(1, 50) + "."}};
    std::string connections = TwoHosts::connection("data", "Queue", "go", "Adaptor", "go") +
                              TwoHosts::connection("data", "Adaptor", "done", "Queue", "done");
    std::string preconnect = "manager.components.preconnect: QueueRtc0.next?port=QueueRtc1.go";
    for (const auto& [port, expected] : of_rtc) {
        connections = TwoHosts::connection("data", "Queue", "out", "Adaptor", port) + connections;
        preconnect += ", QueueRtc0.local?port=QueueRtc1." + port;
    }
    for (const auto& [port, expected] : of_component)
        connections +=
            TwoHosts::connection("data", "Adaptor", port == "sole" ? "sole" : "out", "Queue", port) +
            TwoHosts::connection("data", "Queue", "out", "Queue", "local_" + port);
    connections += TwoHosts::connection("data", "Queue", "out", "Queue", "both") +
                   TwoHosts::connection("data", "Adaptor", "out", "Queue", "both");
    hosts.set_connections(connections);
    std::string conf = preconnect + "\nmanager.components.preactivation: QueueRtc1\n";
    const auto set = [&](const std::string& port, const std::string& setting) {
        conf += "test.QueueRtc.port.inport." + port + ".buffer." + setting + "\n";
    };
    set("one", "length: 1");
    for (const char* port : {"four", "four_refusing", "four_without_readback"}) set(port, "length: 4");
    set("four_refusing", "write.full_policy: do_nothing");
    set("four_without_readback", "read.empty_policy: do_nothing");
    hosts.append_to_rtc_conf(conf);
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "all queues are printed"));
    REQUIRE(hosts.says("rtm", "QueueRtc1.four_without_readback:"));
    for (const auto& [port, expected] : of_rtc) {
        INFO(port);
        CHECK(printed(hosts, "rtm", "QueueRtc1." + port) == expected);
        CHECK(printed(hosts, "rtm", "QueueRtc0." + port) == expected);
    }
    for (const auto& [port, expected] : of_component) {
        INFO(port);
        CHECK(printed(hosts, "opros", "local_" + port) == expected);
        CHECK(printed(hosts, "opros", port) == expected);
    }
    CHECK(printed(hosts, "opros", "refused") == " 46"); // by four_refusing
    CHECK(printed(hosts, "opros", "both") == numbers(47, 50) + ".");
    // Messages that did not fit are counted.
    const auto stats = tandem::test::shm_program({"stats", hosts.link(), "--json"});
    REQUIRE(stats.exit_code == 0);
    const auto json = stats.json();
    const auto of_port = [&](const std::string& port) {
        for (const auto& ring : json["rings"])
            if (ring["name"] == "port " + port) return ring;
        return nlohmann::json();
    };
    for (const auto& [port, kept] :
         {std::pair("plain", 8), {"one", 1}, {"four", 4}, {"four_refusing", 4}, {"sole", 4}}) {
        const auto ring = of_port(port);
        INFO(port << ": " << ring.dump());
        CHECK(ring["sent"] == 50);
        CHECK(ring["received"] == kept);
        const bool refuses = std::string(port) == "four_refusing";
        CHECK(ring["dropped"][refuses ? "refused" : "skipped"] == 50 - kept);
    }
    CHECK(hosts.stop_both());
}

// SPDX-License-Identifier: Apache-2.0
// Settings of single ports in the configuration of both sides, and ports that belong to a composite's
// members.
#include "tests/apps/tandem/program.hpp"
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

using Catch::Contains;

namespace {

/// The ring of a port, as `tandem shm stats` shows it; nothing sent while there is none.
nlohmann::json ring_of(const TwoHosts& hosts, const std::string& port) {
    const auto stats = tandem::test::shm_program({"stats", hosts.link(), "--json"});
    REQUIRE(stats.exit_code == 0);
    const auto json = stats.json();
    for (const auto& ring : json["rings"])
        if (ring["name"] == "port " + port) return ring;
    return nlohmann::json::object({{"sent", 0}});
}
nlohmann::json word_ring(const TwoHosts& hosts) { return ring_of(hosts, "word"); }

/// EchoRtc in a context that never ticks, so that it reads nothing, and messages for it.
struct Unread : TwoHosts {
    explicit Unread(const std::string& full_policy) {
        set_rtc_properties(
            "execution_contexts=SynchExtTriggerEC&port.inport.word.buffer.length=4&port.inport."
            "word.buffer.write.full_policy=" +
            full_policy);
        set_connections(connection("data", "Talker", "word", "Adaptor", "word"));
        start_rtm();
        start_opros();
        REQUIRE(says("opros", "ready"));
    }
    /// The ring's counters after twenty messages more than it has room for, with the sender at rest.
    nlohmann::json counters() const {
        for (int i = 0; i < 1500 && word_ring(*this)["sent"] < 24; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        pause("opros");
        const auto ring = word_ring(*this);
        resume("opros");
        return ring;
    }
};

} // namespace

TEST_CASE("a queue has the length and the drop policy that rtc.conf sets for the InPort") {
    SECTION("do_nothing") {
        Unread hosts("do_nothing");
        const auto ring = hosts.counters();
        CHECK(ring["dropped"]["overwritten"] == 0);
        CHECK(ring["dropped"]["refused"] == ring["sent"].get<int>() - 4);
        CHECK(ring["waiting"] == 4);
        CHECK(hosts.stop_both());
    }
    SECTION("overwrite") {
        Unread hosts("overwrite");
        const auto ring = hosts.counters();
        CHECK(ring["dropped"]["refused"] == 0);
        CHECK(ring["dropped"]["skipped"] == ring["sent"].get<int>() - 4);
        CHECK(ring["waiting"] == 4);
        CHECK(hosts.stop_both());
    }
}

TEST_CASE("converted and undecodable messages are counted once each, in both directions") {
    TwoHosts hosts;
    hosts.leave_out_talker_and_rtc();
    hosts.set_rtc("RangeRtc");
    hosts.add_component("Range", "RangeComp");
    hosts.set_adaptor_properties(TwoHosts::property("convert.number", "narrow") +
                                 TwoHosts::property("convert.small", "narrow"));
    hosts.set_connections(TwoHosts::connection("data", "Adaptor", "number", "Range", "number") +
                          TwoHosts::connection("data", "Range", "small", "Adaptor", "small"));
    hosts.start_rtm();
    hosts.start_opros();
    // Ten of the twenty numbers from 32758 on fit into 16 bits.
    REQUIRE(hosts.says("opros", "RangeComp number 32767\n"));
    REQUIRE(hosts.says("rtm", "RangeRtc small 32767\n"));
    for (int i = 0; i < 1500; ++i) {
        if (ring_of(hosts, "number")["received"] == 20 && ring_of(hosts, "small")["sent"] == 20) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    // The receiver narrows: a value that does not fit has crossed, but is not valid for the receiver.
    const auto number = ring_of(hosts, "number");
    INFO(number.dump());
    CHECK(number["sent"] == 20);
    CHECK(number["received"] == 20);
    CHECK(number["converted"] == 10);
    CHECK(number["undecodable"] == 10);
    // The sender narrows: what does not fit does not cross.
    const auto small = ring_of(hosts, "small");
    INFO(small.dump());
    CHECK(small["sent"] == 20);
    CHECK(small["dropped"]["refused"] == 10);
    CHECK(small["received"] == 10);
    CHECK(small["converted"] == 10);
    CHECK(small["undecodable"] == 0);
    CHECK(hosts.stop_both());
}

TEST_CASE("an OPRoS component is notified which port of the RTC was silent for too long") {
    TwoHosts hosts;
    hosts.set_rtc_properties("execution_contexts=SynchExtTriggerEC");
    hosts.set_adaptor_property("deadline_ms.reply", "20");
    hosts.add_component("Watch", "WatchComp");
    hosts.set_connections(TwoHosts::connection("event", "Adaptor", "missedDeadline", "Watch", "late"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "missedDeadline: reply\n"));
    CHECK(hosts.stop_both());
}

TEST_CASE("an RTC is notified which port of the OPRoS component was silent for too long") {
    TwoHosts hosts;
    hosts.set_rtc("ListenRtc");
    hosts.set_interceptor("rtc=ListenRtc0&deadline_ms.word=20");
    hosts.append_to_rtc_conf(
        "manager.components.preconnect: InterceptorComp0.missedDeadline?port=ListenRtc0.word\n");
    hosts.set_connections(""); // nobody sends words
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "heard: word"));
    CHECK(hosts.stop_both());
}

TEST_CASE("the ports that a composite exports cross, and it is activated with its members") {
    TwoHosts hosts;
    hosts.add_built_in_rtc("PeriodicECSharedComposite?instance_name=Pair0");
    hosts.set_interceptor("rtc=Pair0");
    hosts.append_to_rtc_conf(
        "composite.PeriodicECShared.Pair0.conf.default.members: EchoRtc0\n"
        "composite.PeriodicECShared.Pair0.conf.default.exported_ports: EchoRtc0.word, EchoRtc0.reply\n");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "word") +
                          TwoHosts::connection("data", "Adaptor", "reply", "Talker", "reply"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    const auto before = hosts.restart_rtm("opros");
    CHECK(hosts.says("opros", "reply: hello", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a property of a port that the RTC does not have is reported with the RTC's ports") {
    TwoHosts hosts;
    hosts.set_adaptor_property("names.dictonary", "lookup=find");
    hosts.set_adaptor_property("convert.dictionary", "widen");
    hosts.set_adaptor_property("deadline_ms.repli", "60000");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "ready"));
    CHECK_THAT(
        hosts.output("opros"),
        Contains("Adaptor: property 'names.dictonary': EchoRtc0 has no service port or EventInPort "
                 "'dictonary'; it has "
                 "dictionary; it counts when the port is added\n") &&
            Contains(
                "Adaptor: property 'convert.dictionary': EchoRtc0 has no data port 'dictionary'; it has ") &&
            Contains("Adaptor: property 'deadline_ms.repli': EchoRtc0 has no data port 'repli'; it has "));
    CHECK(hosts.stop_both());
}

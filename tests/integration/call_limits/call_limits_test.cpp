// SPDX-License-Identifier: Apache-2.0
// Long service calls, many at once, and deeply nested ones, in both directions across a link.
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>

namespace {

/// An end of the relay in each host; one of them does `work` with the other.
struct RelayHosts : TwoHosts {
    RelayHosts(bool from_opros, const std::string& work)
        : caller(from_opros ? "opros" : "rtm"), provider(from_opros ? "rtm" : "opros") {
        set_talker("");
        set_rtc("RelayRtc");
        if (!from_opros) set_rtc_properties("conf.default.work=" + work);
        set_interceptor("rtc=RelayRtc0&call_timeout=60000");
        set_adaptor_property("call_timeout", "60000");
        add_component("Relay", "RelayComp", property("work", from_opros ? work : ""));
        set_connections(connection("service", "Relay", "onward", "Adaptor", "relay") +
                        connection("service", "Adaptor", "onward", "Relay", "relay"));
        start_opros();
        start_rtm();
    }
    const std::string caller, provider;
};

} // namespace

TEST_CASE("arguments and results of nearly 64 MiB cross both ways") {
    RelayHosts hosts(GENERATE(true, false), "long");
    CHECK(hosts.says(hosts.caller, "relay: long 1 of 1\n"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("64 callers at once all get their results") {
    RelayHosts hosts(GENERATE(true, false), "callers");
    CHECK(hosts.says(hosts.caller, "relay: callers 64 of 64\n"));
    CHECK(hosts.stop_both());
}

TEST_CASE("two chains of 16 nested calls at once return") {
    RelayHosts hosts(GENERATE(true, false), "deep");
    CHECK(hosts.says(hosts.caller, "relay: deep 2 of 2\n"));
    CHECK(hosts.stop_both());
}

TEST_CASE("a burst of 2000 calls without a reply arrives whole and in order") {
    RelayHosts hosts(GENERATE(true, false), "notes");
    CHECK(hosts.says(hosts.caller, "relay: notes 1 of 1\n"));
    CHECK(hosts.says(hosts.provider, "relay: all notes came in order\n"));
    CHECK(hosts.stop_both());
}

// SPDX-License-Identifier: Apache-2.0
// An RTC behind the bridge whose device needs its time.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

TEST_CASE("an RTC that is slow to activate and to deactivate is waited for across the link") {
    TwoHosts hosts;
    hosts.set_rtc_properties("slow_ms=2500"); // longer than call_timeout, and than its context waits
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "onStart of component Adaptor has taken 2 s so far"));
    CHECK(hosts.says("opros", "reply: hello 5 "));
    CHECK(hosts.stop("opros") == 0);
    CHECK_THAT(hosts.output("opros"), !Catch::Contains("failed"));
    CHECK(hosts.stop("rtm") == 0);
}

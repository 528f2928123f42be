// SPDX-License-Identifier: Apache-2.0
// Object references of the RTM side, kept by the OPRoS side as texts.
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>

TEST_CASE("object references passed to and from an OPRoS component refer to the same objects at the RTC") {
    TwoHosts hosts;
    std::filesystem::copy_file(REFERENCES_SOURCES "/VaultComp.xml", hosts.folder() / "VaultComp.xml");
    hosts.set_talker("VaultComp");
    hosts.set_rtc("MintRtc");
    hosts.set_connections(TwoHosts::connection("service", "Talker", "mint", "Adaptor", "mint") +
                          TwoHosts::connection("service", "Adaptor", "vault", "Talker", "vault"));
    hosts.start_rtm();
    hosts.start_opros();
    // References as result, in, inout and out argument of a service of the RTC, from a caller in OPRoS.
    CHECK(hosts.says("opros", "vault: coins 1 and 2, exchanged 2, former 1, none 0, other text "
                              "IDL:omg.org/CORBA/BAD_PARAM:1.0"));
    // References passed to a service of the OPRoS component, from a caller in RTM.
    CHECK(hosts.says("rtm", "mint: kept 1, none 1, swapped 1, given 2, kept then 2"));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.stop_both());
}

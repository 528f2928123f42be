// SPDX-License-Identifier: Apache-2.0
// A component that crashes in a CORBA call, where none of its callbacks runs.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <csignal>
#include <rtm/CORBA_RTCUtil.h>

using namespace testing;

namespace {

/// What the host's crash report must say. It runs two BadPeers; the second one has crashed in `operation`.
void check_report(RemoteHost& other, const std::string& operation) {
    CHECK(other.host.wait_for_exit() == -SIGABRT);
    INFO(other.host.errors);
    CHECK_THAT(other.host.errors, Catch::Contains("rtm_host: component BadPeer1 crashed in " + operation +
                                                  ": signal 6 (Aborted), in "));
    CHECK_THAT(other.host.errors, Catch::Contains("\n  plugin " TANDEM_TEST_PLUGINS "/TestComponents.so\n"));
}

} // namespace

TEST_CASE(
    "A component that crashes in an operation of its service is named with the operation and its plugin") {
    RemoteHost other("BadPeer,BadPeer");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    RTC::RTObject_var here = consumer.getObjRef();
    RTC::RTObject_var there = other.component(fixture.manager().theORB(), "BadPeer1");
    CORBA_RTCUtil::activate(there.in());
    REQUIRE(CORBA_RTCUtil::connect_by_name("svc", coil::Properties(), here.in(), "calculator", there.in(),
                                           "calculator") == RTC::RTC_OK);
    CORBA::Long rest = 0;
    CHECK(consumer.calculator_->divide(17, 5, rest) == 3);
    CHECK_THROWS_AS(consumer.calculator_->set_mode(Testing::Plain), CORBA::SystemException);
    check_report(other, "set_mode of port calculator");
}

TEST_CASE("A component that crashes in a listener of its port is named with the operation of the transport") {
    ManagerFixture fixture;
    // do_nothing: by the ORB. Otherwise messages after the first one come through shared memory.
    for (const char* full_policy : {"do_nothing", "overwrite"}) {
        INFO(full_policy);
        RemoteHost other("BadPeer,BadPeer");
        REQUIRE(other.host.wait_for_output("ready\n"));
        auto& counter = fixture.create<Counter>("Counter");
        RTC::RTObject_var here = counter.getObjRef();
        RTC::RTObject_var there = other.component(fixture.manager().theORB(), "BadPeer1");
        coil::Properties properties;
        properties.setProperty("dataport.buffer.write.full_policy", full_policy);
        REQUIRE(CORBA_RTCUtil::connect_by_name("data", properties, here.in(), "out", there.in(),
                                               "aborts_later") == RTC::RTC_OK);
        fixture.activate(counter);
        for (int message = 1; message <= 3; ++message) fixture.step(counter);
        check_report(other, "put of port aborts_later");
    }
}

// SPDX-License-Identifier: Apache-2.0
// Components of other processes in manager.components.preactivation.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/name_server.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <rtm/CORBA_RTCUtil.h>

using namespace testing;

namespace {

bool is_active(ManagerFixture& fixture, const RemoteHost& other, const char* component) {
    try {
        RTC::RTObject_var found = other.component(fixture.manager().theORB(), component);
        return !CORBA::is_nil(found.in()) && CORBA_RTCUtil::is_in_active(found.in());
    } catch (const CORBA::SystemException&) {
        return false; // it is not there yet
    }
}

} // namespace

TEST_CASE("A component of another process is activated, by the name at its manager or at a name server") {
    const std::string name_port = unused_port();
    const NameServer names(name_port);
    RemoteHost other("Counter, Counter", unused_port(),
                     {"corba.nameservers:127.0.0.1:" + name_port, "naming.formats:t.host_cxt/%n.rtc",
                      "naming.update.interval:0.1"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {short_check_interval});
    fixture.manager().activateComponentOrThrow("rtcloc://127.0.0.1:" + other.port + "/Counter0");
    CHECK(is_active(fixture, other, "Counter0"));
    fixture.manager().activateComponentOrThrow("rtcloc://127.0.0.1:" + other.port +
                                               "/Counter0"); // a second time
    CHECK(is_active(fixture, other, "Counter0"));
    fixture.manager().activateComponentOrThrow("rtcname://127.0.0.1:" + name_port + "/t.host_cxt/Counter1");
    CHECK(eventually([&] { return is_active(fixture, other, "Counter1"); }));
}

TEST_CASE("A component of a process that starts later is activated then, and not a second time") {
    const std::string port = unused_port();
    ManagerFixture fixture(false, {short_check_interval});
    fixture.manager().activateComponentOrThrow("rtcloc://127.0.0.1:" + port + "/Counter0");
    RemoteHost other("Counter", port);
    REQUIRE(other.host.wait_for_output("ready\n"));
    CHECK(eventually([&] { return is_active(fixture, other, "Counter0"); }));
    RTC::RTObject_var counter = other.component(fixture.manager().theORB(), "Counter0");
    CHECK(CORBA_RTCUtil::deactivate(counter.in()) == RTC::RTC_OK);
    std::this_thread::sleep_for(std::chrono::milliseconds(500)); // some checks
    CHECK_FALSE(is_active(fixture, other, "Counter0"));
}

TEST_CASE("A name that no process can have is an error in preactivation and in preconnect") {
    ManagerFixture fixture(false);
    fixture.create<Accumulator>("Accumulator");
    CHECK_THROWS_WITH(fixture.manager().activateComponentOrThrow("http://127.0.0.1/Counter0"),
                      Catch::Contains("unknown scheme http; expected rtcname or rtcloc"));
    CHECK_THROWS_WITH(fixture.manager().activateComponentOrThrow("rtcname://127.0.0.1"),
                      Catch::Contains("is not a name of a component"));
    CHECK_THROWS_AS(fixture.connect("Accumulator0.in?port=http://127.0.0.1/Counter0.out"), RTC::ManagerError);
}

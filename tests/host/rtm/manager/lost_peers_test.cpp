// SPDX-License-Identifier: Apache-2.0
// Other processes that do not get messages any more, as observers of this process see them.
#include "ToolServicesSkel.h"
#include "tests/host/process/published_notices.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <rtm/CORBA_RTCUtil.h>

using namespace testing;

namespace {

std::vector<std::string> notices() { return published_notices(tandem::process::NoticeKind::lost); }

} // namespace

TEST_CASE(
    "A connection that another process has made and lost is shown to observers until it is made again") {
    ManagerFixture fixture(false, {short_check_interval});
    auto& counter = fixture.create<Counter>("Counter");
    auto other = std::make_unique<RemoteHost>("Reporter");
    REQUIRE(other->host.wait_for_output("ready\n"));
    const auto connect = [&] {
        RTC::RTObject_var there = other->component(fixture.manager().theORB(), "Reporter0");
        return CORBA_RTCUtil::connect_by_name("arm-log", coil::Properties(), there.in(), "in",
                                              RTC::RTObject_var(counter.getObjRef()).in(), "out");
    };
    REQUIRE(connect() == RTC::RTC_OK);
    CHECK(notices().empty());
    other->host.send_signal(SIGKILL);
    CHECK(eventually([] { return !notices().empty(); }));
    CHECK(notices() ==
          std::vector<std::string>{"connection arm-log of Counter0.out is lost: the other side is gone; "
                                   "connect the ports again"});
    other = std::make_unique<RemoteHost>("Reporter");
    REQUIRE(other->host.wait_for_output("ready\n"));
    REQUIRE(connect() == RTC::RTC_OK);
    CHECK(notices().empty());
}

TEST_CASE("A tool that has ended without removing its service is shown to observers until it is removed") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    CORBA::Object_var nobody = fixture.manager().theORB()->string_to_object(
        ("corbaloc:iiop:127.0.0.1:" + unused_port() + "/tool").c_str());
    SDOPackage::ServiceProfile profile;
    profile.id = CORBA::string_dup("tool");
    profile.interface_type = CORBA::string_dup(OpenRTM::ComponentObserver::_PD_repoId);
    profile.service = SDOPackage::SDOService::_unchecked_narrow(nobody.in());
    SDOPackage::Configuration_var configuration = counter.get_configuration();
    REQUIRE(configuration->add_service_profile(profile));
    RTC::RTObject_var reference = counter.getObjRef();
    CHECK(CORBA_RTCUtil::activate(reference.in()) == RTC::RTC_OK);
    CHECK(eventually([] { return !notices().empty(); }));
    CHECK(notices() == std::vector<std::string>{"the tool that observes Counter0 does not answer: nothing is "
                                                "sent to it any more"});
    CHECK(configuration->remove_service_profile("tool"));
    CHECK(notices().empty());
}

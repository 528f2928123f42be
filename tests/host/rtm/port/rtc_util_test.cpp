// SPDX-License-Identifier: Apache-2.0
// Short forms for components that look at each other: CORBA_RTCUtil, the manager as a CORBA object.
#include "tests/host/rtm/manager_fixture.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/ManagerServant.h>

using namespace testing;
namespace util = CORBA_RTCUtil;

TEST_CASE("Connections are found and ended by name and by id and by the other port") {
    ManagerFixture fixture;
    fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    RTC::PortService_var out = util::get_port_by_url("Counter0.out");
    RTC::PortService_var in = util::get_port_by_url("Accumulator0.in");
    REQUIRE_FALSE(CORBA::is_nil(out.in()));
    REQUIRE_FALSE(CORBA::is_nil(in.in()));
    CHECK(CORBA::is_nil(RTC::PortService_var(util::get_port_by_url("Nobody0.out")).in()));
    const coil::Properties usual;

    REQUIRE(util::connect("wire", usual, out.in(), in.in()) == RTC::RTC_OK);
    CHECK(util::get_connector_names(out.in()) == coil::vstring{"wire"});
    CHECK(util::already_connected(out.in(), in.in()));
    CHECK(util::disconnect_connector_name(out.in(), "other") == RTC::BAD_PARAMETER);
    CHECK(util::disconnect_connector_name("Counter0.out", "wire") == RTC::RTC_OK);
    CHECK(util::get_connector_ids(in.in()).empty());

    REQUIRE(util::connect("wire", usual, out.in(), in.in()) == RTC::RTC_OK);
    CHECK(util::disconnect_connector_id(in.in(), util::get_connector_ids(in.in()).at(0)) == RTC::RTC_OK);

    RTC::PortServiceList targets;
    CORBA_SeqUtil::push_back(targets, RTC::PortService::_duplicate(in.in()));
    REQUIRE(util::connect_multi("wires", usual, out.in(), targets) == RTC::RTC_OK);
    CHECK(util::disconnect_name(out.in(), "Nobody0.in") == RTC::BAD_PARAMETER);
    CHECK(util::disconnect_name(out.in(), "Accumulator0.in") == RTC::RTC_OK);

    REQUIRE(util::connect("wire", usual, out.in(), in.in()) == RTC::RTC_OK);
    RTC::ConnectorProfileList_var profiles = out->get_connector_profiles();
    REQUIRE(profiles->length() == 1);
    CHECK(util::disconnect(profiles[0]) == RTC::RTC_OK);
    CHECK(util::disconnect_all("Nobody0.in") == RTC::BAD_PARAMETER);
}

TEST_CASE("Helper functions give the rates, participants and parameters of a component") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    RTC::RTObject_var rtc = counter.getObjRef(), other = accumulator.getObjRef();
    CHECK(util::set_current_rate(rtc.in(), 0, 50) == RTC::RTC_OK);
    CHECK(util::get_current_rate(rtc.in(), 0) == Approx(50));
    CHECK(util::get_current_rate(rtc.in(), 7) == -1);
    RTC::ExecutionContext_var context = util::get_actual_ec(rtc.in());
    CHECK(util::get_ec_id(rtc.in(), context.in()) == 0);

    const CORBA::ULong alone = util::get_participants_rtc(rtc.in()).length();
    CHECK(util::add_rtc_to_default_ec(rtc.in(), other.in()) == RTC::RTC_OK);
    CHECK(util::get_participants_rtc(rtc.in()).length() == alone + 1);
    CHECK(util::remove_rtc_to_default_ec(rtc.in(), other.in()) == RTC::RTC_OK);
    CHECK(util::get_participants_rtc(rtc.in()).length() == alone);

    CHECK(util::set_active_configuration(rtc.in(), "step", "3"));
    CHECK(util::get_parameter_by_key(rtc.in(), "default", "step") == "3");
    CHECK(util::get_active_configuration(rtc.in()).getProperty("step") == "3");
}

TEST_CASE("The manager is a CORBA object for its own components too") {
    ManagerFixture fixture;
    fixture.create<Counter>("Counter");
    RTM::Manager_var manager = fixture.manager().getManagerServant().getObjRef();
    REQUIRE_FALSE(CORBA::is_nil(manager.in()));
    RTC::RTCList_var found = manager->get_components_by_name("Counter0");
    REQUIRE(found->length() == 1);
    CHECK(CORBA_SeqUtil::refToVstring(found.in()).at(0).substr(0, 4) == "IOR:");
}

// SPDX-License-Identifier: Apache-2.0
// Two processes: components of another rtm_host by CORBA alone.
#include "tests/host/rtm/log_lines.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>
#include <rtm/idl/DataPort_OpenRTMSkel.h>

using namespace testing;

namespace {

struct Other : RemoteHost {
    using RemoteHost::RemoteHost;
    RTC::RTObject_ptr component(ManagerFixture& fixture, const char* name) {
        return RemoteHost::component(fixture.manager().theORB(), name);
    }
};

/// Peers that fail, as those of OpenRTM-aist-Python do with shared_memory under Python 3.
struct FailingReceiver : POA_OpenRTM::InPortCdr {
    OpenRTM::PortStatus put(const OpenRTM::CdrData&) override { throw CORBA::UNKNOWN(); }
};
struct FailingSender : POA_OpenRTM::OutPortCdr {
    OpenRTM::PortStatus get(OpenRTM::CdrData_out) override { throw CORBA::UNKNOWN(); }
};

/// Connects a port with an object that is not a port's.
void connect_with(RTC::PortBase& port, const char* dataflow_type, const char* key, CORBA::Object_ptr object) {
    coil::Properties properties;
    properties.setProperty("dataport.dataflow_type", dataflow_type);
    properties.setProperty("dataport.interface_type", "corba_cdr");
    properties.setProperty(
        key, CORBA::String_var(RTC::Manager::instance().theORB()->object_to_string(object)).in());
    RTC::ConnectorProfile profile;
    profile.name = "failing";
    profile.ports.length(1);
    profile.ports[0] = RTC::PortService::_duplicate(port.getPortRef());
    NVUtil::copyFromProperties(profile.properties, properties);
    REQUIRE(port.connect(profile) == RTC::RTC_OK);
}

} // namespace

TEST_CASE("A peer that answers each message with an error is logged once for a connection") {
    ManagerFixture fixture(true, {"logger.log_level:ERROR"});
    LogLines lines("failing");
    fixture.manager().getLogStreamBuf().addStream(&lines);
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    FailingReceiver receiver;
    FailingSender sender;
    connect_with(counter.out_, "push", "dataport.corba_cdr.inport_ior",
                 OpenRTM::InPortCdr_var(receiver._this()).in());
    connect_with(accumulator.in_, "pull", "dataport.corba_cdr.outport_ior",
                 OpenRTM::OutPortCdr_var(sender._this()).in());
    for (int i = 0; i < 3; ++i) {
        CHECK_FALSE(counter.out_.write());
        CHECK_FALSE(accumulator.in_.read());
    }
    const std::string lost = " answers with PORT_ERROR, and messages are lost; its process may log why\n";
    CHECK(lines.get() == "connections: connection failing: the receiver" + lost +
                             "connections: connection failing: the sender" + lost);
    fixture.manager().getLogStreamBuf().removeStream(&lines);
}

TEST_CASE("A connection with one port and no address of the other side is refused") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    RTC::ConnectorProfile profile;
    profile.ports.length(1);
    profile.ports[0] = RTC::PortService::_duplicate(counter.out_.getPortRef());
    CHECK(counter.out_.connect(profile) != RTC::RTC_OK);
    CHECK(std::string(counter.out_.connectError()) ==
          "Counter0.out: the other side offers no corba_cdr reference to push to");
    CHECK(counter.out_.getConnectorIds().empty());
}

TEST_CASE("A push connection to several InPorts of other processes is refused") {
    Other other("Reporter,Reporter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    RTC::ConnectorProfile profile;
    profile.ports.length(3);
    profile.ports[0] = RTC::PortService::_duplicate(counter.out_.getPortRef());
    for (CORBA::ULong i : {1u, 2u}) {
        RTC::RTObject_var there = other.component(fixture, i == 1 ? "Reporter0" : "Reporter1");
        profile.ports[i] = CORBA_RTCUtil::get_port_by_name(there.in(), "in");
    }
    CHECK(counter.out_.connect(profile) == RTC::BAD_PARAMETER);
    CHECK_THAT(counter.out_.connectError(), Catch::Contains("connect each InPort separately"));
    CHECK(counter.out_.getConnectorIds().empty());
    for (CORBA::ULong i : {1u, 2u})
        CHECK(RTC::ConnectorProfileList_var(profile.ports[i]->get_connector_profiles())->length() == 0);
}

TEST_CASE("A component of another process shows its profile, ports, contexts and configuration") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTC::RTObject_var counter = other.component(fixture, "Counter0");
    REQUIRE_FALSE(CORBA::is_nil(counter.in()));
    CHECK(counter->_is_a("IDL:openrtm.aist.go.jp/OpenRTM/DataFlowComponent:1.0"));
    RTC::ComponentProfile_var profile = counter->get_component_profile();
    CHECK(std::string(profile->instance_name) == "Counter0");
    CHECK(CORBA_RTCUtil::get_outport_names(counter.in()) == coil::vstring{"Counter0.out"});
    CHECK(CORBA_RTCUtil::get_default_rate(counter.in()) == 200);
    CHECK(CORBA_RTCUtil::is_in_inactive(counter.in()));
    CHECK(CORBA_RTCUtil::set_configuration(counter.in(), "default", "step", "3"));
    CHECK(CORBA_RTCUtil::get_configuration(counter.in(), "default").getProperty("step") == "3");
    CHECK(CORBA_RTCUtil::activate(counter.in()) == RTC::RTC_OK);
    CHECK(CORBA_RTCUtil::is_in_active(counter.in()));
    CHECK(CORBA_RTCUtil::deactivate(counter.in()) == RTC::RTC_OK);
}

TEST_CASE("A manager finds its components by instance name with and without their category") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var there = other.manager(fixture.manager().theORB());
    const auto found = [&](const std::string& name) {
        return RTC::RTCList_var(there->get_components_by_name(name.c_str()))->length();
    };
    RTC::ComponentProfile_var profile =
        RTC::RTObject_var(other.component(fixture, "Counter0"))->get_component_profile();
    CHECK(found("Counter0") == 1);
    CHECK(found("*/Counter0") == 1);
    CHECK(found(std::string(profile->category) + "/Counter0") == 1);
    CHECK(found("another/Counter0") == 0);
    CHECK(found("*/Counter") == 0);
    CHECK(found("") == 0);
}

TEST_CASE("Data crosses processes in both directions, and a receiver that dies is dropped") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:200"});
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    auto& counter = fixture.create<Counter>("Counter");
    RTC::RTObject_var here_in = accumulator.getObjRef(), here_out = counter.getObjRef();
    RTC::RTObject_var there_out = other.component(fixture, "Counter0"),
                      there_in = other.component(fixture, "Reporter0");
    coil::Properties push, pull;
    push.setProperty("dataport.dataflow_type", "push");
    CHECK(CORBA_RTCUtil::connect_by_name("in", push, there_out.in(), "out", here_in.in(), "in") ==
          RTC::RTC_OK);
    CHECK(CORBA_RTCUtil::connect_by_name("out", push, here_out.in(), "out", there_in.in(), "in") ==
          RTC::RTC_OK);
    CHECK(CORBA_RTCUtil::connect_by_name("again", push, here_out.in(), "out", there_in.in(), "in") !=
          RTC::RTC_OK);
    for (auto* rtc : {&here_in, &here_out, &there_in, &there_out}) CORBA_RTCUtil::activate(rtc->in());
    CHECK(eventually([&] { return accumulator.received_ >= 10; }));
    CHECK(other.host.wait_for_output("received "));

    other.host.send_signal(SIGKILL);
    CHECK(eventually([&] { return counter.out_.getConnectorIds().empty(); }));
    CHECK(fixture.state(counter) == RTC::ACTIVE_STATE);
}

TEST_CASE("A port itself looks for a duplicate and does not make ports of other processes do so") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    RTC::RTObject_var there = other.component(fixture, "Reporter0");
    RTC::PortService_var in = CORBA_RTCUtil::get_port_by_name(there.in(), "in");
    auto connect = [&](const coil::Properties& properties) {
        RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
            "c", properties, RTC::PortService_var(counter.out_.getPortRef()).in(), in.in());
        return counter.out_.connect(profile.inout());
    };
    CHECK(connect(coil::Properties()) == RTC::RTC_OK);
    RTC::ConnectorProfileList_var present = in->get_connector_profiles();
    REQUIRE(present->length() == 1);
    CHECK(NVUtil::toString(present[0].properties, "dataport.allow_dup_connection") == "YES");
    CHECK(connect(coil::Properties()) == RTC::PRECONDITION_NOT_MET);
    CHECK(std::string(counter.out_.connectError()) == "Counter0.out is already connected to that port");
    coil::Properties duplicates;
    duplicates.setProperty("dataport.allow_dup_connection", "YES");
    CHECK(connect(duplicates) == RTC::RTC_OK);
}

// As a port of OpenRTM-aist begins one.
TEST_CASE("A port refuses a connection with one of another type that has begun it without a comparison") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    RTC::TimedString value;
    RTC::InPort<RTC::TimedString> text("text", value);
    accumulator.addInPort("text", text);
    RTC::RTObject_var there = other.component(fixture, "Counter0");
    RTC::PortService_var out = CORBA_RTCUtil::get_port_by_name(there.in(), "out");
    const auto begin = [&](RTC::PortBase& port) {
        coil::Properties push;
        push.setProperty("dataport.dataflow_type", "push");
        RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
            "c", push, out.in(), RTC::PortService_var(port.getPortRef()).in());
        profile->connector_id = port.getName();
        return out->notify_connect(profile.inout());
    };
    CHECK(begin(text) == RTC::BAD_PARAMETER);
    CHECK_THAT(std::string(text.connectError()),
               Catch::Contains("Accumulator0.text carries IDL:RTC/TimedString:1.0, "
                               "Counter0.out carries IDL:RTC/TimedLong:1.0"));
    CHECK(text.getConnectorIds().empty());
    CHECK(begin(accumulator.in_) == RTC::RTC_OK);
    accumulator.removePort(text);
}

TEST_CASE("A pull connection fetches from another process") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    RTC::RTObject_var here = accumulator.getObjRef(), there = other.component(fixture, "Counter0");
    coil::Properties pull;
    pull.setProperty("dataport.dataflow_type", "pull");
    REQUIRE(CORBA_RTCUtil::connect_by_name("pull", pull, there.in(), "out", here.in(), "in") == RTC::RTC_OK);
    CORBA_RTCUtil::activate(there.in());
    CHECK(eventually([&] { return accumulator.in_.read() && accumulator.value_.data > 0; }));
}

TEST_CASE("A service of another process is called, and gone when its process is") {
    Other other;
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    RTC::RTObject_var here = consumer.getObjRef(), there = other.component(fixture, "CalculatorProvider0");
    REQUIRE(CORBA_RTCUtil::connect_by_name("svc", coil::Properties(), here.in(), "calculator", there.in(),
                                           "calculator") == RTC::RTC_OK);
    Testing::Numbers numbers;
    numbers.length(2);
    numbers[0] = 1.5;
    numbers[1] = 2;
    CHECK_THROWS_AS(consumer.calculator_->sum(numbers), CORBA::OBJECT_NOT_EXIST);
    CORBA_RTCUtil::activate(there.in());
    CHECK(consumer.calculator_->sum(numbers) == 3.5);
    other.host.send_signal(SIGKILL);
    other.host.wait_for_exit();
    CHECK_THROWS_AS(consumer.calculator_->sum(numbers), CORBA::SystemException);
}

TEST_CASE("A service may take longer than a call of the framework up to a separate time limit") {
    RemoteHost other("CalculatorProvider");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false,
                           {"corba.args:-ORBclientCallTimeOutPeriod 300", "manager.service_call_timeout:20"});
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    RTC::RTObject_var there = other.component(fixture.manager().theORB(), "CalculatorProvider0");
    CORBA_RTCUtil::activate(there.in());
    auto call_while_it_stands_still = [&] {
        RTC::RTObject_var here = consumer.getObjRef();
        REQUIRE(CORBA_RTCUtil::connect_by_name("svc", coil::Properties(), here.in(), "calculator", there.in(),
                                               "calculator") == RTC::RTC_OK);
        REQUIRE(other.host.suspend());
        std::thread later([&] {
            std::this_thread::sleep_for(std::chrono::seconds(1));
            other.host.send_signal(SIGCONT);
        });
        bool answered = true;
        try {
            consumer.calculator_->sum(Testing::Numbers());
        } catch (const CORBA::TIMEOUT&) {
            answered = false;
        }
        later.join();
        CHECK(consumer.port_.disconnect_all() == RTC::RTC_OK);
        return answered;
    };
    CHECK(call_while_it_stands_still());
    fixture.manager().getConfig().setProperty("manager.service_call_timeout", "0.3");
    CHECK_FALSE(call_while_it_stands_still());
}

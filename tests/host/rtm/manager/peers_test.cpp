// SPDX-License-Identifier: Apache-2.0
// Peers in other processes that come late, leave, die, hang and send rubbish.
#include "tests/host/rtm/fixture.hpp"
#include "tests/host/rtm/other_host.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/idl/DataPort_OpenRTMSkel.h>

using namespace testing;

namespace {

const std::string quick_watch = "manager.peer_check_interval:0.05";

std::size_t connections(RTC::PortBase& port) {
    RTC::ConnectorProfileList_var list = port.get_connector_profiles();
    return list->length();
}

RTC::ReturnCode_t connect(RTC::PortBase& ours, RTC::RTObject_ptr theirs, const char* port,
                          const std::vector<std::pair<std::string, std::string>>& properties = {}) {
    coil::Properties all;
    for (const auto& [key, value] : properties) all.setProperty("dataport." + key, value);
    RTC::PortService_var other = CORBA_RTCUtil::get_port_by_name(theirs, port);
    RTC::PortService_var own = ours.getPortRef();
    RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector("c", all, own.in(), other.in());
    return ours.connect(profile.inout());
}

// Writes until the Teller over there says what it received: it does so from 10 on, and a buffer holds 8.
bool tells(HostProcess& host, Counter& counter) {
    for (int i = 0; i < 600; ++i) {
        counter.out_.write();
        if (host.says("received ", std::chrono::milliseconds(50))) return true;
    }
    return false;
}

} // namespace

TEST_CASE(
    "A preconnect waits for a process that comes later and is made again when that has died and is back") {
    const std::string port = free_port();
    Stage stage(false, {quick_watch, "exec_cxt.periodic.rate:200"});
    auto& summer = stage.create<Summer>("Summer");
    CORBA_RTCUtil::activate(RTC::RTObject_var(summer.getObjRef()).in());
    CHECK_NOTHROW(stage.connect("rtcloc://127.0.0.1:" + port + "/Counter0.out?port=Summer0.in"));
    CHECK(connections(summer.in_) == 0);
    for (int life = 0; life < 2; ++life) {
        OtherHost other("Counter", port, {"manager.components.preactivation:Counter0"});
        REQUIRE(other.host.says("ready\n"));
        const long before = summer.received_;
        CHECK(soon([&] { return connections(summer.in_) == 1; }));
        CHECK(soon([&] { return summer.received_ > before + 10; }));
        other.host.send(SIGKILL);
        other.host.wait();
        CHECK(soon([&] { return connections(summer.in_) == 0; }));
    }
}

TEST_CASE("A kept connection that somebody ends on purpose stays ended") {
    OtherHost other("Counter");
    REQUIRE(other.host.says("ready\n"));
    Stage stage(false, {quick_watch});
    auto& summer = stage.create<Summer>("Summer");
    stage.connect("Summer0.in?port=rtcloc://127.0.0.1:" + other.port + "/Counter0.out");
    CHECK(connections(summer.in_) == 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // some rounds of the watch
    CHECK(summer.in_.disconnect_all() == RTC::RTC_OK);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CHECK(connections(summer.in_) == 0);
}

TEST_CASE("A name that cannot be is an error and one that is not there yet is not") {
    Stage stage;
    stage.create<Summer>("Summer");
    CHECK_THROWS_WITH(stage.connect("Summer0.in?port=rtcloc://127.0.0.1:9/noport"),
                      Catch::Contains("is no port"));
    CHECK_THROWS_WITH(stage.connect("Summer0.nope?port=rtcloc://127.0.0.1:9/Counter0.out"),
                      Catch::Contains("has no port nope"));
    CHECK_NOTHROW(stage.connect("Summer0.in?port=rtcname://127.0.0.1:9/a.host_cxt/Counter0.out"));
}

TEST_CASE("A peer that dies or hangs in its notify_connect leaves nothing behind") {
    OtherHost other("BadPeer");
    REQUIRE(other.host.says("ready\n"));
    Stage stage(true, {"corba.args:-ORBclientCallTimeOutPeriod 500"});
    auto& counter = stage.create<Counter>("Counter");
    auto& summer = stage.create<Summer>("Summer");
    RTC::RTObject_var bad = other.component(stage.manager().theORB(), "BadPeer0");
    CHECK(connect(counter.out_, bad.in(), "hangs") != RTC::RTC_OK);
    CHECK_THAT(counter.out_.connectError(), Catch::Contains("no answer in time"));
    CHECK(connections(counter.out_) == 0);
    CHECK(connect(counter.out_, bad.in(), "dies") != RTC::RTC_OK);
    CHECK(connections(counter.out_) == 0);
    CHECK(counter.out_.getConnectorIds().empty());
    CHECK(other.host.wait() == 3);
    stage.connect("Counter0.out?port=Summer0.in");
    stage.activate(counter);
    stage.activate(summer);
    for (int i = 0; i < 3; ++i) {
        stage.step(counter);
        stage.step(summer);
    }
    CHECK(summer.received_ > 0);
}

TEST_CASE("A peer that dies or hangs in its notify_disconnect leaves nothing behind") {
    OtherHost other("BadPeer"), well("Teller");
    REQUIRE(other.host.says("ready\n"));
    REQUIRE(well.host.says("ready\n"));
    Stage stage(true, {"corba.args:-ORBclientCallTimeOutPeriod 500"});
    auto& counter = stage.create<Counter>("Counter");
    auto* orb = stage.manager().theORB();
    RTC::RTObject_var bad = other.component(orb, "BadPeer0"), teller = well.component(orb, "Teller0");
    REQUIRE(connect(counter.out_, teller.in(), "in") == RTC::RTC_OK);
    REQUIRE(connect(counter.out_, bad.in(), "hangs_late") == RTC::RTC_OK);
    REQUIRE(connect(counter.out_, bad.in(), "dies_late") == RTC::RTC_OK);
    CHECK(connections(counter.out_) == 3);
    for (const int left : {2, 1}) {
        RTC::ConnectorProfileList_var all = counter.out_.get_connector_profiles();
        CHECK(counter.out_.disconnect(all[1].connector_id) == RTC::RTC_OK);
        CHECK(connections(counter.out_) == static_cast<std::size_t>(left));
        CHECK(counter.out_.getConnectorIds().size() == static_cast<std::size_t>(left));
    }
    CHECK(other.host.wait() == 3);
    CORBA_RTCUtil::activate(teller.in());
    stage.activate(counter);
    for (int i = 0; i < 40; ++i) {
        stage.step(counter);
        if (i % 4 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10)); // the buffer holds 8
    }
    CHECK(tells(well.host, counter));
}

TEST_CASE("A component that does not return from onExecute keeps no tool from the others") {
    OtherHost other("Counter,Hanger", free_port(), {"manager.components.preactivation:Counter0,Hanger0"});
    REQUIRE(other.host.says("hanging\n"));
    REQUIRE(other.host.says("ready\n"));
    Stage stage;
    auto* orb = stage.manager().theORB();
    RTC::RTObject_var counter = other.component(orb, "Counter0"), hanger = other.component(orb, "Hanger0");
    for (int i = 0; i < 3; ++i) {
        CHECK(CORBA_RTCUtil::deactivate(counter.in()) == RTC::RTC_OK);
        CHECK(CORBA_RTCUtil::activate(counter.in()) == RTC::RTC_OK);
    }
    CHECK(CORBA_RTCUtil::deactivate(hanger.in()) == RTC::RTC_ERROR);
    CHECK(CORBA_RTCUtil::is_in_active(hanger.in()));
    CHECK(counter->exit() == RTC::RTC_OK);
    RTM::Manager_var manager = other.manager(orb);
    RTC::RTCList_var left = manager->get_components();
    CHECK(left->length() == 1);
    other.host.send(SIGTERM);
    CHECK(other.host.wait() == 0);
}

TEST_CASE("Whichever way a receiver that hangs is sent to the others get what is theirs") {
    OtherHost stuck("Teller"), well("Teller");
    REQUIRE(stuck.host.says("ready\n"));
    REQUIRE(well.host.says("ready\n"));
    Stage stage(true);
    auto& counter = stage.create<Counter>("Counter");
    auto* orb = stage.manager().theORB();
    RTC::RTObject_var a = stuck.component(orb, "Teller0"), b = well.component(orb, "Teller0");
    for (auto* one : {&a, &b}) CORBA_RTCUtil::activate(one->in());
    REQUIRE(connect(counter.out_, b.in(), "in") == RTC::RTC_OK);
    for (const char* way : {"flush", "new", "periodic"})
        for (const char* full : {"overwrite", "do_nothing", "block"})
            REQUIRE(connect(counter.out_, a.in(), "in",
                            {{"subscription_type", way},
                             {"push_rate", "200"},
                             {"allow_dup_connection", "YES"},
                             {"buffer.write.full_policy", full},
                             {"buffer.write.timeout", "0.01"}}) == RTC::RTC_OK);
    stage.activate(counter);
    REQUIRE(stuck.host.freeze());
    for (int i = 0; i < 60; ++i) {
        counter.value_.data = i;
        counter.out_.write();
        if (i % 4 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10)); // the buffer holds 8
    }
    CHECK(tells(well.host, counter));
    CHECK(stuck.host.output.find("received ") == std::string::npos);
    stuck.host.send(SIGCONT);
    CHECK(tells(stuck.host, counter));
}

TEST_CASE("A sender that hangs keeps an InPort that pulls from it waiting once and no other component") {
    OtherHost stuck("Counter", free_port(), {"manager.components.preactivation:Counter0"});
    REQUIRE(stuck.host.says("ready\n"));
    Stage stage(true);
    auto& puller = stage.create<Summer>("Summer");
    auto& summer = stage.create<Summer>("Summer");
    auto& counter = stage.create<Counter>("Counter");
    stage.connect("Counter0.out?port=Summer1.in");
    RTC::RTObject_var there = stuck.component(stage.manager().theORB(), "Counter0");
    REQUIRE(connect(puller.in_, there.in(), "out", {{"dataflow_type", "pull"}}) == RTC::RTC_OK);
    CHECK(soon([&] { return puller.in_.read(); }));
    REQUIRE(stuck.host.freeze());
    for (auto* one : std::initializer_list<RTC::RTObject_impl*>{&puller, &summer, &counter})
        stage.activate(*one);
    int refused = 0;
    for (int i = 0; i < 50; ++i) {
        if (!puller.in_.read()) ++refused; // waits for an answer once in two seconds at most
        stage.step(counter);
        stage.step(summer);
    }
    CHECK(refused > 40);
    CHECK(summer.received_ == 50);
    stuck.host.send(SIGCONT);
    CHECK(soon([&] { return puller.in_.read(); }));
}

TEST_CASE(
    "An InPort that pulls from two senders reads both and the other one when the first hangs or is dead") {
    OtherHost first("Counter", free_port(), {"manager.components.preactivation:Counter0"});
    OtherHost second("Counter?conf.default.step=-1", free_port(),
                     {"manager.components.preactivation:Counter0"});
    REQUIRE(first.host.says("ready\n"));
    REQUIRE(second.host.says("ready\n"));
    Stage stage(true, {"manager.peer_check_interval:3600"}); // the watch lets go of nobody
    auto& puller = stage.create<Summer>("Summer");
    auto* orb = stage.manager().theORB();
    for (auto* host : {&first, &second}) {
        RTC::RTObject_var there = host->component(orb, "Counter0");
        REQUIRE(connect(puller.in_, there.in(), "out", {{"dataflow_type", "pull"}}) == RTC::RTC_OK);
    }
    auto reads = [&](int sign) {
        return soon([&] { return puller.in_.read() && sign * puller.value_.data > 0; });
    };
    CHECK(reads(1));
    REQUIRE(first.host.freeze());
    while (puller.in_.read() && puller.value_.data > 0) continue; // what was on its way
    for (int i = 0; i < 20; ++i) REQUIRE(reads(-1));
    first.host.send(SIGKILL);
    for (int i = 0; i < 20; ++i) REQUIRE(reads(-1));
    CHECK(connections(puller.in_) == 2);
}

TEST_CASE("A receiver that hangs keeps nothing from the others and is served again when it goes on") {
    OtherHost stuck("Teller"), well("Teller");
    REQUIRE(stuck.host.says("ready\n"));
    REQUIRE(well.host.says("ready\n"));
    Stage stage(true);
    auto& counter = stage.create<Counter>("Counter");
    auto* orb = stage.manager().theORB();
    RTC::RTObject_var a = stuck.component(orb, "Teller0"), b = well.component(orb, "Teller0");
    REQUIRE(connect(counter.out_, a.in(), "in") == RTC::RTC_OK);
    REQUIRE(connect(counter.out_, b.in(), "in") == RTC::RTC_OK);
    for (auto* one : {&a, &b}) CORBA_RTCUtil::activate(one->in());
    stage.activate(counter);
    stage.step(counter);
    REQUIRE(stuck.host.freeze());
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        counter.value_.data = i;
        if (!counter.out_.write()) ++refused;
        if (i % 8 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10)); // the buffer holds 8
    }
    CHECK(refused == 0);
    CHECK(tells(well.host, counter));
    CHECK(stuck.host.output.find("received ") == std::string::npos);
    stuck.host.send(SIGCONT);
    CHECK(tells(stuck.host, counter));
    CHECK(counter.out_.getConnectorIds().size() == 2);
}

TEST_CASE("data_service and both byte orders carry values between processes by push and by pull") {
    OtherHost other("Counter,Teller");
    REQUIRE(other.host.says("ready\n"));
    Stage stage(false, {"exec_cxt.periodic.rate:200"});
    auto& summer = stage.create<Summer>("Summer");
    auto& counter = stage.create<Counter>("Counter");
    auto* orb = stage.manager().theORB();
    RTC::RTObject_var here = summer.getObjRef(), sender = counter.getObjRef();
    RTC::RTObject_var there = other.component(orb, "Counter0"), teller = other.component(orb, "Teller0");
    for (auto* one : {&here, &sender, &there, &teller}) CORBA_RTCUtil::activate(one->in());
    for (const char* interface_type : {"corba_cdr", "data_service"})
        for (const char* order : {"little", "big"}) {
            INFO(interface_type << " " << order);
            const long before = summer.received_;
            REQUIRE(connect(summer.in_, there.in(), "out",
                            {{"interface_type", interface_type}, {"serializer.cdr.endian", order}}) ==
                    RTC::RTC_OK);
            CHECK(soon([&] { return summer.received_ > before + 3; }));
            CHECK(summer.value_.data > 0);
            CHECK(summer.value_.data < 1000000); // bytes in the wrong order would be more
            CHECK(summer.in_.disconnect_all() == RTC::RTC_OK);

            CORBA_RTCUtil::deactivate(here.in()); // now this thread reads
            REQUIRE(connect(summer.in_, there.in(), "out",
                            {{"interface_type", interface_type},
                             {"serializer.cdr.endian", order},
                             {"dataflow_type", "pull"}}) == RTC::RTC_OK);
            summer.value_.data = 0;
            CHECK(soon([&] { return summer.in_.read() && summer.value_.data > 0; }));
            CHECK(summer.value_.data < 1000000);
            CHECK(summer.in_.disconnect_all() == RTC::RTC_OK);
            CORBA_RTCUtil::activate(here.in());
        }
    CHECK(connect(summer.in_, there.in(), "out", {{"serializer.cdr.endian", "middle"}}) ==
          RTC::BAD_PARAMETER);
    CHECK_THAT(summer.in_.connectError(), Catch::Contains("expected little or big"));
}

TEST_CASE("Bytes that are no message of the port's type are dropped and the next good one is read") {
    Stage stage;
    auto& summer = stage.create<Summer>("Summer");
    auto& counter = stage.create<Counter>("Counter");
    stage.connect("Counter0.out?port=Summer0.in");
    RTC::ConnectorProfileList_var profiles = summer.in_.get_connector_profiles();
    const std::string ior = NVUtil::toString(profiles[0].properties, "dataport.corba_cdr.inport_ior");
    CORBA::Object_var object = stage.manager().theORB()->string_to_object(ior.c_str());
    OpenRTM::InPortCdr_var inlet = OpenRTM::InPortCdr::_narrow(object.in());
    REQUIRE_FALSE(CORBA::is_nil(inlet.in()));
    for (CORBA::ULong length : {0u, 1u, 3u, 11u, 13u, 100000u}) {
        OpenRTM::CdrData bytes;
        bytes.length(length);
        for (CORBA::ULong i = 0; i < length; ++i) bytes[i] = 0xff;
        CHECK(inlet->put(bytes) == OpenRTM::PORT_OK); // it is the reader who knows the type
        CHECK(summer.in_.isNew());
        CHECK(summer.in_.read() == (length >= 12));
    }
    counter.value_.data = 42;
    CHECK(counter.out_.write());
    CHECK(summer.in_.read());
    CHECK(summer.value_.data == 42);
}

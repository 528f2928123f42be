// SPDX-License-Identifier: Apache-2.0
// Two processes: components of another rtm_host by CORBA alone.
#include "fixture.hpp"
#include "host_process.hpp"
#include <netinet/in.h>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/idl/ManagerSkel.h>
#include <sys/socket.h>

using namespace testing;

namespace {

std::string free_port() {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(fd, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
    close(fd);
    return std::to_string(ntohs(address.sin_port));
}

/// Another host with components, reached through its manager's well-known name.
struct Other {
    std::string port = free_port();
    HostProcess host{{"-o", "manager.modules.load_path:" TANDEM_TEST_PLUGINS, "-o",
                      "manager.modules.preload:TestComponents.so", "-o",
                      "manager.components.precreate:Counter,Teller,CalculatorProvider", "-o",
                      "exec_cxt.periodic.rate:200", "-p", port}};

    RTC::RTObject_ptr component(Stage& stage, const char* name) {
        CORBA::Object_var object = stage.manager().theORB()->string_to_object(
            ("corbaloc:iiop:127.0.0.1:" + port + "/manager").c_str());
        RTM::Manager_var manager = RTM::Manager::_narrow(object.in());
        RTC::RTCList_var found = manager->get_components_by_name(name);
        return found->length() == 1 ? RTC::RTObject::_duplicate(found[0]) : RTC::RTObject::_nil();
    }
};

template <class Condition>
bool soon(Condition condition) {
    for (int i = 0; i < 10000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

} // namespace

TEST_CASE("A component of another process shows its profile, ports, contexts and configuration") {
    Other other;
    REQUIRE(other.host.says("ready\n"));
    Stage stage;
    RTC::RTObject_var counter = other.component(stage, "Counter0");
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

TEST_CASE("Data crosses processes in both directions, and a receiver that dies is dropped") {
    Other other;
    REQUIRE(other.host.says("ready\n"));
    Stage stage(false, {"exec_cxt.periodic.rate:200"});
    auto& summer = stage.create<Summer>("Summer");
    auto& counter = stage.create<Counter>("Counter");
    RTC::RTObject_var here_in = summer.getObjRef(), here_out = counter.getObjRef();
    RTC::RTObject_var there_out = other.component(stage, "Counter0"),
                      there_in = other.component(stage, "Teller0");
    coil::Properties push, pull;
    push.setProperty("dataport.dataflow_type", "push");
    CHECK(CORBA_RTCUtil::connect_by_name("in", push, there_out.in(), "out", here_in.in(), "in") ==
          RTC::RTC_OK);
    CHECK(CORBA_RTCUtil::connect_by_name("out", push, here_out.in(), "out", there_in.in(), "in") ==
          RTC::RTC_OK);
    CHECK(CORBA_RTCUtil::connect_by_name("again", push, here_out.in(), "out", there_in.in(), "in") !=
          RTC::RTC_OK);
    for (auto* rtc : {&here_in, &here_out, &there_in, &there_out}) CORBA_RTCUtil::activate(rtc->in());
    CHECK(soon([&] { return summer.received_ >= 10; }));
    CHECK(other.host.says("received 1"));

    other.host.send(SIGKILL);
    CHECK(soon([&] { return counter.out_.getConnectorIds().empty(); }));
    CHECK(stage.state(counter) == RTC::ACTIVE_STATE);
}

TEST_CASE("A pull connection fetches from another process") {
    Other other;
    REQUIRE(other.host.says("ready\n"));
    Stage stage;
    auto& summer = stage.create<Summer>("Summer");
    RTC::RTObject_var here = summer.getObjRef(), there = other.component(stage, "Counter0");
    coil::Properties pull;
    pull.setProperty("dataport.dataflow_type", "pull");
    REQUIRE(CORBA_RTCUtil::connect_by_name("pull", pull, there.in(), "out", here.in(), "in") == RTC::RTC_OK);
    CORBA_RTCUtil::activate(there.in());
    CHECK(soon([&] { return summer.in_.read() && summer.value_.data > 0; }));
}

TEST_CASE("A service of another process is called, and gone when its process is") {
    Other other;
    REQUIRE(other.host.says("ready\n"));
    Stage stage;
    auto& consumer = stage.create<CalculatorConsumer>("CalculatorConsumer");
    RTC::RTObject_var here = consumer.getObjRef(), there = other.component(stage, "CalculatorProvider0");
    REQUIRE(CORBA_RTCUtil::connect_by_name("svc", coil::Properties(), here.in(), "calculator", there.in(),
                                           "calculator") == RTC::RTC_OK);
    Testing::Numbers numbers;
    numbers.length(2);
    numbers[0] = 1.5;
    numbers[1] = 2;
    CHECK_THROWS_AS(consumer.calculator_->sum(numbers), CORBA::OBJECT_NOT_EXIST);
    CORBA_RTCUtil::activate(there.in());
    CHECK(consumer.calculator_->sum(numbers) == 3.5);
    other.host.send(SIGKILL);
    other.host.wait();
    CHECK_THROWS_AS(consumer.calculator_->sum(numbers), CORBA::SystemException);
}

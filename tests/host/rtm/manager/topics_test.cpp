// SPDX-License-Identifier: Apache-2.0
// Connections by publish_topic, subscribe_topic and rendezvous_point.
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "tests/host/rtm/log_lines.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/name_server.hpp"
#include "tests/host/rtm/remote_host.hpp"

using namespace testing;

namespace {

const std::string publishing = "port.outport.out.publish_topic:chatter",
                  subscribing = "port.inport.in.subscribe_topic:chatter";

std::string name_of_first_connection(RTC::PortBase& port) {
    RTC::ConnectorProfileList_var list = port.get_connector_profiles();
    REQUIRE(list->length() > 0);
    return static_cast<const char*>(list[0].name);
}

} // namespace

TEST_CASE("Data ports of one topic are connected without a name server, in the order of their creation") {
    ManagerFixture fixture(true, {publishing, subscribing});
    auto& early = fixture.create<Accumulator>("Accumulator");
    CHECK(connection_count(early.in_) == 0);
    auto& counter = fixture.create<Counter>("Counter");
    auto& late = fixture.create<Accumulator>("Accumulator");
    auto& other = fixture.create<Accumulator>("Accumulator?port.inport.in.subscribe_topic=news");
    CHECK(name_of_first_connection(early.in_) == "Counter0.out:Accumulator0.in");
    CHECK(name_of_first_connection(late.in_) == "Accumulator1.in:Counter0.out");
    CHECK(connection_count(counter.out_) == 2);
    CHECK(connection_count(other.in_) == 0);
    for (RTC::RTObject_impl* component :
         {static_cast<RTC::RTObject_impl*>(&counter), static_cast<RTC::RTObject_impl*>(&early)})
        fixture.activate(*component);
    for (int i = 0; i < 3; ++i) fixture.step(counter);
    fixture.step(early);
    CHECK(early.received_ == 3);
    CHECK(counter.exit() == RTC::RTC_OK);
    fixture.manager().cleanupComponents();
    fixture.create<Counter>("Counter");
    CHECK(connection_count(early.in_) == 1);
}

TEST_CASE("Service ports of one rendezvous point are connected") {
    ManagerFixture fixture(true, {"port.corba.rendezvous_point:desk"});
    auto& provider = fixture.create<CalculatorProvider>("CalculatorProvider");
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    fixture.activate(provider);
    fixture.activate(consumer);
    CHECK(connection_count(consumer.port_) == 1);
    CHECK(std::string(CORBA::String_var(consumer.calculator_->name())) == "calculator");
}

TEST_CASE("A topic that does not fit the port, or ports whose types differ, are reported in one line") {
    LogLines unfit("no effect"), refused("name one topic");
    ManagerFixture fixture(true, {"logger.log_level:WARN"});
    fixture.manager().getLogStreamBuf().addStream(&unfit);
    fixture.manager().getLogStreamBuf().addStream(&refused);
    fixture.create<Counter>("Counter?port.outport.out.subscribe_topic=chatter");
    CHECK_THAT(unfit.get(), Catch::Contains("Counter0.out: subscribe_topic has no effect at a DataOutPort; "
                                            "set publish_topic"));
    struct Words : RTC::DataFlowComponentBase {
        explicit Words(RTC::Manager* m) : DataFlowComponentBase(m), in("in", value) {}
        RTC::ReturnCode_t onInitialize() override {
            addInPort("in", in);
            return RTC::RTC_OK;
        }
        RTC::TimedString value;
        RTC::InPort<RTC::TimedString> in;
    };
    register_component_type<Words>(fixture.manager(), "Words");
    fixture.create<Counter>("Counter?port.outport.out.publish_topic=chatter");
    fixture.create<Words>("Words?port.inport.in.subscribe_topic=chatter");
    CHECK(coil::split(refused.get(), "\n", true).size() == 1);
    CHECK_THAT(refused.get(), Catch::Contains("Words0.in and Counter1.out") && Catch::Contains("carries"));
    fixture.manager().getLogStreamBuf().removeStream(&unfit);
    fixture.manager().getLogStreamBuf().removeStream(&refused);
}

TEST_CASE("Ports of one topic in two processes are connected through a name server, which may start later") {
    const std::string name_port = unused_port(), server = "corba.nameservers:127.0.0.1:" + name_port;
    const std::string update = "naming.update.interval:0.1";
    RemoteHost other("Counter", unused_port(), {server, update, publishing});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {"naming.enable:YES", server, update, subscribing});
    auto& early = fixture.create<Accumulator>("Accumulator");
    CHECK(connection_count(early.in_) == 0);
    const NameServer names(name_port);
    CHECK(eventually([&] { return connection_count(early.in_) == 1; }));
    auto& late = fixture.create<Accumulator>("Accumulator");
    CHECK(eventually([&] { return connection_count(late.in_) == 1; }));
    CHECK(late.exit() == RTC::RTC_OK);
    CosNaming::NamingContext_var root =
        RTC::resolve_name_server(fixture.manager().theORB(), "127.0.0.1:" + name_port);
    const std::string topic = "dataports.port_cxt/chatter.topic_cxt/";
    CORBA::Object_var bound = root->resolve(RTC::to_corba_name(topic + "Accumulator0.in.inport"));
    CHECK(bound->_is_equivalent(RTC::PortService_var(early.in_.getPortRef()).in()));
    CHECK_THROWS_AS(root->resolve(RTC::to_corba_name(topic + "Accumulator1.in.inport")),
                    CosNaming::NamingContext::NotFound);
}

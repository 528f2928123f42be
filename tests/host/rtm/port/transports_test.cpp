// SPDX-License-Identifier: Apache-2.0
// Interface types that libraries register: their consumers and providers carry the data, and nobody else.
#include "tests/host/rtm/manager_fixture.hpp"
#include <map>
#include <rtm/InPortConsumer.h>
#include <rtm/InPortProvider.h>
#include <rtm/OutPortConsumer.h>
#include <rtm/OutPortProvider.h>

using namespace testing;

namespace {

// Stands for the network of this transport: maps addresses to listeners.
std::map<std::string, RTC::InPortConnector*> listening;
std::map<std::string, std::function<RTC::BufferStatus(RTC::ByteData&)>> waiting;
std::function<void(RTC::ByteData&)> on_received;
int live_endpoints = 0;
std::string colour_setting;

struct LiveCount {
    LiveCount() { ++live_endpoints; }
    ~LiveCount() { --live_endpoints; }
};

struct TestInPortProvider : RTC::InPortProvider, LiveCount {
    TestInPortProvider() { setInterfaceType("post"); }
    ~TestInPortProvider() override { listening.erase("box"); }
    void init(coil::Properties& prop) override { colour_setting = prop.getProperty("post.colour"); }
    void setBuffer(RTC::BufferBase<RTC::ByteData>*) override {}
    void setListener(RTC::ConnectorInfo& info, RTC::ConnectorListenersBase* listeners) override {
        on_received = [connector = info, listeners](RTC::ByteData& data) mutable {
            listeners->notifyIn(RTC::ConnectorDataListenerType::ON_RECEIVED, connector, data);
        };
    }
    void setConnector(RTC::InPortConnector* connector) override {
        listening["box"] = connector;
        CORBA_SeqUtil::push_back(m_properties, NVUtil::newNV("dataport.post.address", "box"));
    }
};

struct TestInPortConsumer : RTC::InPortConsumer, LiveCount {
    void init(coil::Properties&) override {}
    RTC::DataPortStatus put(RTC::ByteData& data) override {
        const auto found = listening.find(address);
        if (found == listening.end()) return RTC::DataPortStatus::CONNECTION_LOST;
        on_received(data);
        return found->second->write(data) == RTC::BufferStatus::OK ? RTC::DataPortStatus::PORT_OK
                                                                   : RTC::DataPortStatus::BUFFER_ERROR;
    }
    void publishInterfaceProfile(SDOPackage::NVList&) override {}
    bool subscribeInterface(const SDOPackage::NVList& properties) override {
        if (NVUtil::find_index(properties, "dataport.post.address") < 0) return false;
        address = NVUtil::toString(properties, "dataport.post.address");
        return true;
    }
    void unsubscribeInterface(const SDOPackage::NVList&) override { address.clear(); }
    std::string address;
};

/// Needs no address from the other port.
struct TestMailer : TestInPortConsumer {
    RTC::DataPortStatus put(RTC::ByteData& data) override {
        const auto found = listening.find("box");
        if (found == listening.end()) return RTC::DataPortStatus::CONNECTION_LOST;
        return found->second->write(data) == RTC::BufferStatus::OK ? RTC::DataPortStatus::PORT_OK
                                                                   : RTC::DataPortStatus::BUFFER_ERROR;
    }
    bool subscribeInterface(const SDOPackage::NVList&) override { return true; }
};

struct TestOutPortProvider : RTC::OutPortProvider, LiveCount {
    TestOutPortProvider() { setInterfaceType("post"); }
    ~TestOutPortProvider() override { waiting.erase("shelf"); }
    void setBuffer(RTC::CdrBufferBase*) override {}
    void setListener(RTC::ConnectorInfo& info, RTC::ConnectorListenersBase* listeners) override {
        info_ = info;
        listeners_ = listeners;
    }
    void setConnector(RTC::OutPortConnector* connector) override {
        waiting["shelf"] = [this, connector](RTC::ByteData& data) {
            const auto status = connector->read(data);
            if (status == RTC::BufferStatus::OK)
                listeners_->notifyOut(RTC::ConnectorDataListenerType::ON_SEND, info_, data);
            return status;
        };
    }
    RTC::ConnectorInfo info_;
    RTC::ConnectorListenersBase* listeners_ = nullptr;
};

struct TestOutPortConsumer : RTC::OutPortConsumer, LiveCount {
    void init(coil::Properties&) override {}
    void setBuffer(RTC::CdrBufferBase*) override {}
    void setListener(RTC::ConnectorInfo&, RTC::ConnectorListenersBase*) override {}
    RTC::DataPortStatus get(RTC::ByteData& data) override {
        return waiting.at("shelf")(data) == RTC::BufferStatus::OK ? RTC::DataPortStatus::PORT_OK
                                                                  : RTC::DataPortStatus::BUFFER_EMPTY;
    }
    bool subscribeInterface(const SDOPackage::NVList&) override { return waiting.count("shelf") == 1; }
    void unsubscribeInterface(const SDOPackage::NVList&) override {}
};

struct ReceivedValues : RTC::ConnectorDataListenerT<RTC::TimedLong> {
    USE_CONNLISTENER_STATUS;
    explicit ReceivedValues(std::vector<int>& received_values) : values(received_values) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedLong& value) override {
        values.push_back(static_cast<int>(value.data));
        return NO_CHANGE;
    }
    std::vector<int>& values;
};

template <class Base, class Transport>
void register_transport() {
    coil::GlobalFactory<Base>::instance().addFactory("post", coil::Creator<Base, Transport>,
                                                     coil::Destructor<Base, Transport>);
}

std::string interface_types(RTC::PortBase& port) {
    RTC::PortProfile_var profile = port.get_port_profile();
    return NVUtil::toString(profile->properties, "dataport.interface_type");
}

} // namespace

TEST_CASE("a registered push transport carries the data of connections that ask for it") {
    register_transport<RTC::InPortProvider, TestInPortProvider>();
    register_transport<RTC::InPortConsumer, TestInPortConsumer>();
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    CHECK_THAT(interface_types(counter.out_), Catch::Contains("post"));
    CHECK_THAT(interface_types(accumulator.in_), Catch::Contains("post"));
    CHECK_THAT(interface_types(accumulator.in_), Catch::Contains("corba_cdr"));

    fixture.connect("Counter0.out?port=Accumulator0.in&interface_type=post&post.colour=red");
    std::vector<int> received_values;
    accumulator.in_.addConnectorDataListener(RTC::ON_RECEIVED, new ReceivedValues(received_values));
    CHECK(colour_setting == "red");
    CHECK(live_endpoints == 2);
    fixture.activate(counter);
    fixture.activate(accumulator);
    for (int i = 0; i < 4; ++i) {
        fixture.step(counter);
        fixture.step(accumulator);
    }
    CHECK(accumulator.received_ == 4);
    CHECK(accumulator.sum_ == 10);
    CHECK(received_values == std::vector<int>{1, 2, 3, 4}); // from the provider

    listening.clear(); // no message takes another way
    fixture.step(counter);
    fixture.step(accumulator);
    CHECK(accumulator.received_ == 4);
    counter.out_.disconnect_all();
    CHECK(live_endpoints == 0);
}

TEST_CASE("a registered pull transport fetches what waits at the OutPort") {
    register_transport<RTC::OutPortProvider, TestOutPortProvider>();
    register_transport<RTC::OutPortConsumer, TestOutPortConsumer>();
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&interface_type=post&dataflow_type=pull");
    std::vector<int> sent;
    counter.out_.addConnectorDataListener(RTC::ON_SEND, new ReceivedValues(sent));
    fixture.activate(counter);
    for (int i = 0; i < 3; ++i) fixture.step(counter);
    for (int i = 0; i < 3; ++i) {
        REQUIRE(accumulator.in_.read());
        CHECK(accumulator.value_.data == i + 1);
    }
    CHECK(sent == std::vector<int>{1, 2, 3});
    counter.out_.disconnect_all();
    CHECK(live_endpoints == 0);
}

TEST_CASE("a connection is refused if one end lacks its transport, and the error names that end") {
    register_transport<RTC::InPortConsumer, TestInPortConsumer>();
    ManagerFixture fixture;
    fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    CHECK_THROWS_WITH(fixture.connect("Counter0.out?port=Accumulator0.in&interface_type=post"),
                      Catch::Contains("post has no InPortProvider"));
    CHECK(live_endpoints == 0);
}

TEST_CASE("a port whose transport finds the other side by itself is connected alone, in either order") {
    register_transport<RTC::InPortProvider, TestInPortProvider>();
    register_transport<RTC::InPortConsumer, TestMailer>();
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?interface_type=post");
    fixture.connect("Accumulator0.in?interface_type=post");
    CHECK(live_endpoints == 2);
    RTC::ConnectorProfileList_var made = counter.out_.get_connector_profiles();
    REQUIRE(made->length() == 1);
    CHECK(made[0].ports.length() == 1);
    CHECK(std::string(made[0].name) == "Counter0.out");
    fixture.activate(counter);
    fixture.activate(accumulator);
    for (int i = 0; i < 4; ++i) {
        fixture.step(counter);
        fixture.step(accumulator);
    }
    CHECK(accumulator.received_ == 4);
    counter.out_.disconnect_all();
    accumulator.in_.disconnect_all();
    CHECK(live_endpoints == 0);
}

TEST_CASE("an entry that names one port and no interface type is refused") {
    ManagerFixture fixture;
    fixture.create<Counter>("Counter");
    for (const char* entry : {"Counter0.out", "Counter0.out?push_policy=all"})
        CHECK_THROWS_WITH(fixture.connect(entry),
                          Catch::Contains("names one port only; expected A.p?port=B.q") &&
                              Catch::Contains("A.p?interface_type=TYPE"));
    CHECK_THROWS_WITH(fixture.connect("Counter0.out?interface_type=pots"),
                      Catch::Contains("interface_type is pots, expected corba_cdr"));
}

TEST_CASE("a port makes only connections of the interface types that its settings allow") {
    ManagerFixture fixture(true, {"port.inport.dataport.provider_types:direct, data_service",
                                  "port.outport.dataport.provider_types:ALL"});
    fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    CHECK_THROWS_WITH(
        fixture.connect("Counter0.out?port=Accumulator0.in"),
        Catch::Contains("Accumulator0.in: interface_type is corba_cdr, expected direct, data_service") &&
            Catch::Contains("provider_types"));
    fixture.connect("Counter0.out?port=Accumulator0.in&dataflow_type=pull"); // the InPort consumes
    auto& other = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator1.in&interface_type=data_service");
    CHECK(RTC::ConnectorProfileList_var(other.in_.get_connector_profiles())->length() == 1);
}

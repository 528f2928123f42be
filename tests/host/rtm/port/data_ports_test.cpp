// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/publisher.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <atomic>
#include <rtm/CdrRingBuffer.h>
#include <thread>

using namespace testing;

TEST_CASE("What an OutPort writes is new in the InPort at once and read once") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    CHECK_FALSE(counter.out_.write());
    CHECK_FALSE(accumulator.in_.isNew());
    fixture.connect("Counter0.out?port=Accumulator0.in");

    counter.value_.data = 42;
    REQUIRE(counter.out_.write());
    REQUIRE(accumulator.in_.isNew());
    REQUIRE(accumulator.in_.read());
    CHECK(accumulator.value_.data == 42);
    CHECK(accumulator.in_.isEmpty());
    CHECK(accumulator.in_.read()); // readback is the default policy
    CHECK(accumulator.value_.data == 42);
}

namespace {

/// Sends 1, 2, 3 through a buffer of length 2 and returns the sum of what arrives.
long sum_through_buffer_of_two(ManagerFixture& fixture, const std::string& policy, Counter& counter) {
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&buffer.length=2&buffer.write.full_policy=" + policy);
    for (int i = 1; i <= 3; ++i) {
        counter.value_.data = i;
        counter.out_.write();
    }
    fixture.activate(accumulator);
    fixture.step(accumulator);
    return accumulator.sum_;
}

} // namespace

TEST_CASE("A full buffer that overwrites keeps the newest values") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    CHECK(sum_through_buffer_of_two(fixture, "overwrite", counter) == 2 + 3);
    CHECK(counter.out_.getStatus(0) == RTC::DataPortStatus::PORT_OK);
}

TEST_CASE("A full buffer that does nothing refuses new values and says so") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    CHECK(sum_through_buffer_of_two(fixture, "do_nothing", counter) == 1 + 2);
    CHECK(counter.out_.getStatus(0) == RTC::DataPortStatus::BUFFER_FULL);
}

TEST_CASE("Components in step pass every value on, in order") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter?step=2");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in");
    REQUIRE(fixture.activate(counter) == RTC::RTC_OK);
    REQUIRE(fixture.activate(accumulator) == RTC::RTC_OK);
    for (int i = 0; i < 100; ++i) {
        fixture.step(counter);
        fixture.step(accumulator);
    }
    CHECK(accumulator.received_ == 100);
    CHECK(accumulator.sum_ == 2 * 100 * 101 / 2);
}

TEST_CASE("One OutPort serves several InPorts, one InPort several OutPorts") {
    ManagerFixture fixture;
    auto& a = fixture.create<Counter>("Counter");
    auto& b = fixture.create<Counter>("Counter");
    auto& x = fixture.create<Accumulator>("Accumulator");
    auto& y = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&port=Accumulator1.in");
    fixture.connect("Counter1.out?port=Accumulator1.in");
    a.value_.data = 1;
    a.out_.write();
    b.value_.data = 10;
    b.out_.write();
    for (auto* accumulator : {&x, &y}) {
        fixture.activate(*accumulator);
        fixture.step(*accumulator);
    }
    CHECK(x.sum_ == 1);
    CHECK(y.sum_ == 11);
}

TEST_CASE("A pull connection delivers when the reader asks") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&dataflow_type=pull");
    CHECK_FALSE(accumulator.in_.isNew());
    counter.value_.data = 7;
    REQUIRE(counter.out_.write());
    CHECK(accumulator.in_.isNew());
    REQUIRE(accumulator.in_.read());
    CHECK(accumulator.value_.data == 7);
}

TEST_CASE("Ports that do not fit are refused with both types, and nothing stays connected") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    RTC::TimedDouble value;
    RTC::InPort<RTC::TimedDouble> real("real", value);
    counter.addInPort("real", real);
    CHECK_THROWS_WITH(fixture.connect("Counter0.out?port=Counter0.real"),
                      Catch::Contains("IDL:RTC/TimedLong:1.0") && Catch::Contains("IDL:RTC/TimedDouble:1.0"));
    CHECK_THROWS_WITH(fixture.connect("Counter0.real?port=Accumulator0.in"), Catch::Contains("DataInPort"));
    CHECK_THROWS_WITH(fixture.connect("Counter0.out?port=Accumulator0.im"), Catch::Contains("it has: in"));
    CHECK_THROWS_WITH(fixture.connect("Counter0.out?port=Accumulator0.in&buffer_type=none_such"),
                      Catch::Contains("none_such"));
    CHECK(counter.out_.connectors().empty());
    fixture.connect("Counter0.out?port=Accumulator0.in");
    CHECK_THROWS_WITH(fixture.connect("Counter0.out?port=Accumulator0.in"),
                      Catch::Contains("already connected"));
    counter.removePort(real);
}

TEST_CASE("Disconnecting notifies both sides, and writing continues without the receiver") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in");
    const std::string id = accumulator.in_.getConnectorIds().at(0);
    CHECK(counter.out_.getConnectorIds().at(0) == id);
    CHECK(accumulator.in_.disconnect(id.c_str()) == RTC::RTC_OK);
    CHECK(counter.out_.connectors().empty());
    CHECK(accumulator.in_.connectors().empty());
    CHECK_FALSE(counter.out_.write());
    CHECK_FALSE(accumulator.in_.read());
}

namespace {

struct ValueListener : RTC::ConnectorDataListenerT<RTC::TimedLong> {
    USE_CONNLISTENER_STATUS;
    std::vector<long>* values;
    explicit ValueListener(std::vector<long>& v) : values(&v) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedLong& data) override {
        values->push_back(data.data);
        data.data += 100;
        return DATA_CHANGED;
    }
};
struct ValueListener1x : RTC::ConnectorDataListenerT<RTC::TimedLong> {
    std::vector<long>* values;
    explicit ValueListener1x(std::vector<long>& v) : values(&v) {}
    void operator()(const RTC::ConnectorInfo&, const RTC::TimedLong& data) override {
        values->push_back(data.data);
    }
};
struct BytesListener : RTC::ConnectorDataListener {
    USE_CONNLISTENER_STATUS;
    std::vector<long>* values;
    explicit BytesListener(std::vector<long>& v) : values(&v) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData& bytes, const std::string& type) override {
        CHECK(type == "cdr");
        values->push_back(static_cast<long>(bytes.getDataLength()));
        return NO_CHANGE;
    }
};
// The forms of 1.2 and of 1.0 for bytes
struct AddingStreamListener : RTC::ConnectorDataListener {
    USE_CONNLISTENER_STATUS;
    ReturnCode operator()(RTC::ConnectorInfo&, cdrMemoryStream& stream) override {
        RTC::TimedLong data;
        data <<= stream;
        data.data += 1000;
        stream.rewindPtrs();
        data >>= stream;
        return DATA_CHANGED;
    }
};
struct StreamListener1x : RTC::ConnectorDataListener {
    std::vector<long>* values;
    explicit StreamListener1x(std::vector<long>& v) : values(&v) {}
    void operator()(const RTC::ConnectorInfo&, const cdrMemoryStream& stream) override {
        values->push_back(static_cast<long>(stream.bufSize()));
    }
};
struct ConnectListener : RTC::ConnectorListener {
    std::vector<std::string>* names;
    explicit ConnectListener(std::vector<std::string>& n) : names(&n) {}
    void operator()(const RTC::ConnectorInfo& info) override { names->push_back(info.name); }
};

} // namespace

TEST_CASE("Listeners of 1.2 may change the stream and those of 1.0 hear streams and connections") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    std::vector<long> sizes;
    std::vector<std::string> connected;
    accumulator.in_.addConnectorDataListener(RTC::ON_RECEIVED, new AddingStreamListener());
    accumulator.in_.addConnectorDataListener(RTC::ON_BUFFER_WRITE, new StreamListener1x(sizes));
    counter.out_.addConnectorListener(RTC::ON_CONNECT, new ConnectListener(connected));
    fixture.connect("Counter0.out?port=Accumulator0.in");
    CHECK(connected.size() == 1);
    counter.value_.data = 5;
    counter.out_.write();
    CHECK(sizes == std::vector<long>{12});
    accumulator.in_.read();
    CHECK(accumulator.value_.data == 1005);
}

TEST_CASE("Listeners hear values or bytes, in the 2.x and the 1.x form, and may change what is received") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    std::vector<long> sent, received, bytes;
    counter.out_.addConnectorDataListener(RTC::ON_SEND, new ValueListener1x(sent));
    accumulator.in_.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED,
                                             new ValueListener(received));
    accumulator.in_.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_BUFFER_WRITE,
                                             new BytesListener(bytes));
    fixture.connect("Counter0.out?port=Accumulator0.in");
    counter.value_.data = 5;
    counter.out_.write();
    CHECK(sent == std::vector<long>{5});
    CHECK(received == std::vector<long>{5});
    CHECK(bytes == std::vector<long>{12});
    accumulator.in_.read();
    CHECK(accumulator.value_.data == 105);
}

TEST_CASE("A timestamp policy sets the time of the message, and the writer's variable is unchanged") {
    const std::string policy = GENERATE("on_write", "on_send", "on_received", "on_read");
    static ManagerFixture fixture;
    static auto& counter = fixture.create<Counter>("Counter");
    static auto& accumulator = fixture.create<Accumulator>("Accumulator");
    counter.out_.disconnect_all();
    fixture.connect("Counter0.out?port=Accumulator0.in&timestamp_policy=" + policy);
    counter.value_.tm = RTC::Time{0, 0};
    counter.out_.write();
    accumulator.in_.read();
    CHECK(accumulator.value_.tm.sec > 1000000000u);
    CHECK(counter.value_.tm.sec == 0);
}

TEST_CASE("The subscription type new delivers from a separate thread") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&subscription_type=new");
    counter.value_.data = 9;
    REQUIRE(counter.out_.write());
    for (int i = 0; i < 5000 && !accumulator.in_.isNew(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    REQUIRE(accumulator.in_.read());
    CHECK(accumulator.value_.data == 9);
}

TEST_CASE(
    "A publisher delivers nothing more once a delivery has lost the connection, even if messages wait") {
    const std::string type = GENERATE("new", "periodic");
    coil::Properties properties;
    properties.setProperty("subscription_type", type);
    properties.setProperty("push_policy", "all");
    properties.setProperty("push_rate", "1000");
    std::atomic<bool> all_written{false};
    std::atomic<int> deliveries{0};
    auto publisher = RTC::Publisher::create(properties, "slow", [&](RTC::ByteData&) {
        ++deliveries;
        while (!all_written) std::this_thread::yield();
        return RTC::DataPortStatus::CONNECTION_LOST;
    });
    const RTC::ByteData message;
    bool overwritten = false;
    for (int i = 0; i < 3; ++i) CHECK(publisher->write(message, overwritten) == RTC::DataPortStatus::PORT_OK);
    all_written = true;
    while (publisher->write(message, overwritten) != RTC::DataPortStatus::CONNECTION_LOST)
        std::this_thread::yield();
    publisher.reset(); // joins the thread
    CHECK(deliveries == 1);
}

// SPDX-License-Identifier: Apache-2.0
// Which listeners are called: those of connectors, connections, component actions and configuration; and the callbacks of
// ports.
#include "tests/host/rtm/manager_fixture.hpp"

using namespace testing;

namespace {

using EventNames = std::vector<std::string>;

std::mutex events_mutex; // each publisher has a thread

struct DataEventListener : RTC::ConnectorDataListener {
    USE_CONNLISTENER_STATUS;
    DataEventListener(std::string& s, const char* n) : events(s), name(n) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData&, const std::string&) override {
        std::lock_guard<std::mutex> lock(events_mutex);
        events += name + " ";
        return NO_CHANGE;
    }
    std::string& events;
    std::string name;
};
struct InfoEventListener : RTC::ConnectorListener {
    USE_CONNLISTENER_STATUS;
    InfoEventListener(std::string& s, const char* n) : events(s), name(n) {}
    ReturnCode operator()(RTC::ConnectorInfo&) override {
        std::lock_guard<std::mutex> lock(events_mutex);
        events += name + " ";
        return NO_CHANGE;
    }
    std::string& events;
    std::string name;
};

template <class Port>
void listen_to_all_events(Port& port, std::string& events) {
    for (int i = 0; i < static_cast<int>(RTC::ConnectorDataListenerType::CONNECTOR_DATA_LISTENER_NUM); ++i) {
        const auto type = static_cast<RTC::ConnectorDataListenerType>(i);
        port.addConnectorDataListener(
            type, new DataEventListener(events, RTC::ConnectorDataListener::toString(type)));
    }
    for (int i = 0; i < static_cast<int>(RTC::ConnectorListenerType::CONNECTOR_LISTENER_NUM); ++i) {
        const auto type = static_cast<RTC::ConnectorListenerType>(i);
        port.addConnectorListener(type,
                                  new InfoEventListener(events, RTC::ConnectorListener::toString(type)));
    }
}

struct ListenedConnection {
    std::string out, in;
    Counter& counter;
    Accumulator& accumulator;
    ListenedConnection(ManagerFixture& fixture, const std::string& properties)
        : counter(fixture.create<Counter>("Counter")),
          accumulator(fixture.create<Accumulator>("Accumulator")) {
        listen_to_all_events(counter.out_, out);
        listen_to_all_events(accumulator.in_, in);
        fixture.connect("Counter0.out?port=Accumulator0.in&" + properties);
    }
    ~ListenedConnection() {
        counter.exit();
        accumulator.exit();
        RTC::Manager::instance().cleanupComponents();
    }
    EventNames take() {
        std::lock_guard<std::mutex> lock(events_mutex);
        return {std::exchange(out, ""), std::exchange(in, "")};
    }
};

} // namespace

TEST_CASE("A flush connection reports sending and receiving, and what the buffer does") {
    const std::string interface = GENERATE("corba_cdr", "direct");
    static ManagerFixture fixture;
    CAPTURE(interface);
    ListenedConnection connection(
        fixture, "buffer.length=2&buffer.write.full_policy=do_nothing&buffer.read.empty_policy=do_nothing"
                 "&interface_type=" +
                     interface);
    CHECK(connection.take() == EventNames{"ON_CONNECT ", "ON_CONNECT "});
    connection.counter.out_.write();
    CHECK(connection.take() == EventNames{"ON_SEND ON_RECEIVED ", "ON_RECEIVED ON_BUFFER_WRITE "});
    connection.counter.out_.write();
    connection.take();
    CHECK_FALSE(connection.counter.out_.write());
    CHECK(connection.take()[0] == "ON_SEND ON_RECEIVER_FULL ");
    connection.accumulator.in_.read();
    CHECK(connection.take() == EventNames{"", "ON_BUFFER_READ "});
    connection.accumulator.in_.read();
    connection.take();
    connection.accumulator.in_.read();
    CHECK(connection.take() == EventNames{"", "ON_BUFFER_EMPTY "});
    connection.accumulator.in_.disconnect_all();
    CHECK(connection.take() == EventNames{"ON_DISCONNECT ", "ON_DISCONNECT "});
}

TEST_CASE("A buffer that overwrites or times out reports it") {
    const std::string interface = GENERATE("corba_cdr", "direct");
    static ManagerFixture fixture;
    CAPTURE(interface);
    {
        ListenedConnection connection(fixture, "buffer.length=1&interface_type=" + interface);
        connection.counter.out_.write();
        connection.take();
        connection.counter.out_.write();
        CHECK(connection.take()[1] == "ON_RECEIVED ON_BUFFER_OVERWRITE ON_BUFFER_WRITE ");
        connection.accumulator.in_.read();
        connection.take();
        connection.counter.out_.write();
        CHECK(connection.take()[1] == "ON_RECEIVED ON_BUFFER_WRITE ");
    }
    {
        ListenedConnection connection(
            fixture, "buffer.length=1&buffer.write.full_policy=do_nothing&interface_type=" + interface);
        connection.counter.out_.write();
        connection.take();
        connection.counter.out_.write();
        CHECK(connection.take()[1] == "ON_RECEIVED ON_BUFFER_FULL ON_RECEIVER_FULL ");
    }
    ListenedConnection connection(fixture,
                                  "buffer.length=1&buffer.write.full_policy=block&buffer.write.timeout=0.001&"
                                  "buffer.read.empty_policy=block&buffer.read.timeout=0.001&interface_type=" +
                                      interface);
    connection.counter.out_.write();
    connection.take();
    CHECK_FALSE(connection.counter.out_.write());
    const EventNames timed_out = connection.take();
    CHECK(timed_out[0] == "ON_SEND ON_RECEIVER_TIMEOUT ");
    CHECK(timed_out[1] == "ON_RECEIVED ON_BUFFER_WRITE_TIMEOUT ON_RECEIVER_TIMEOUT ");
    connection.accumulator.in_.read();
    connection.take();
    CHECK_FALSE(connection.accumulator.in_.read());
    CHECK(connection.take()[1] == "ON_BUFFER_READ_TIMEOUT ");
}

TEST_CASE("A pull connection reports the events of its buffer on the sending side") {
    ManagerFixture fixture;
    ListenedConnection connection(fixture, "dataflow_type=pull&buffer.read.empty_policy=do_nothing");
    connection.take();
    connection.counter.out_.write();
    CHECK(connection.take() == EventNames{"ON_BUFFER_WRITE ", ""});
    connection.accumulator.in_.read();
    CHECK(connection.take() == EventNames{"ON_BUFFER_READ ON_SEND ", "ON_RECEIVED "});
    connection.accumulator.in_.read();
    CHECK(connection.take()[0] == "ON_BUFFER_EMPTY ON_SENDER_EMPTY ");
}

TEST_CASE("A pull connection reports each value that it overwrites, and no other") {
    static ManagerFixture fixture;
    const std::string policy = GENERATE("overwrite", "do_nothing");
    CAPTURE(policy);
    ListenedConnection connection(fixture,
                                  "dataflow_type=pull&buffer.length=2&buffer.write.full_policy=" + policy);
    connection.counter.out_.write();
    connection.counter.out_.write();
    CHECK(connection.take()[0] == "ON_CONNECT ON_BUFFER_WRITE ON_BUFFER_WRITE ");
    connection.counter.out_.write();
    CHECK(connection.take()[0] ==
          (policy == "overwrite" ? "ON_BUFFER_OVERWRITE ON_BUFFER_WRITE " : "ON_BUFFER_FULL "));
}

// The receiver takes a message only when the first look at its buffer is past: the publisher's own buffer fills up.
TEST_CASE("A subscription to new data reports to the sender each message that it overwrites, and no other") {
    static ManagerFixture fixture;
    const std::string policy = GENERATE("overwrite", "do_nothing");
    CAPTURE(policy);
    ListenedConnection connection(fixture, "subscription_type=periodic&push_rate=0.001&buffer.length=2"
                                           "&buffer.write.full_policy=" +
                                               policy);
    connection.take();
    connection.counter.out_.write();
    connection.counter.out_.write();
    CHECK(connection.take()[0] == "ON_BUFFER_WRITE ON_BUFFER_WRITE ");
    connection.counter.out_.write();
    CHECK(connection.take()[0] == (policy == "overwrite" ? "ON_BUFFER_WRITE ON_BUFFER_OVERWRITE "
                                                         : "ON_BUFFER_WRITE ON_BUFFER_FULL "));
}

namespace {

// Returns which of 1 ... 6 arrive through a publisher, in the order of arrival.
std::vector<long> published(ManagerFixture& fixture, const std::string& properties, std::size_t min_values) {
    ListenedConnection connection(fixture, "buffer.length=16&" + properties);
    for (connection.counter.value_.data = 1; connection.counter.value_.data <= 6;
         ++connection.counter.value_.data)
        REQUIRE(connection.counter.out_.write());
    std::vector<long> values_read;
    for (int i = 0; i < 3000 && values_read.size() < min_values; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        while (connection.accumulator.in_.isNew() && connection.accumulator.in_.read())
            values_read.push_back(connection.accumulator.value_.data);
    }
    return values_read;
}

} // namespace

TEST_CASE("A periodic subscription sends what its policy chooses at each period") {
    ManagerFixture fixture;
    const std::string periodic = "subscription_type=periodic&publisher.push_rate=20&publisher.push_policy=";
    CHECK(published(fixture, periodic + "all", 6) == std::vector<long>{1, 2, 3, 4, 5, 6});
    CHECK(published(fixture, periodic + "fifo", 3).front() == 1);
    CHECK(published(fixture, periodic + "skip&publisher.skip_count=1", 3) == std::vector<long>{2, 4, 6});
    CHECK(published(fixture, periodic + "new", 1).back() == 6);
    CHECK(published(fixture, "subscription_type=periodic&push_rate=20", 1).back() ==
          6); // new, as OpenRTM-aist
}

TEST_CASE("A subscription to new data loses none when it asks for all") {
    ManagerFixture fixture;
    CHECK(published(fixture, "subscription_type=new&publisher.push_policy=all", 6) ==
          std::vector<long>{1, 2, 3, 4, 5, 6});
    CHECK(published(fixture, "subscription_type=new", 1).back() <= 6);
}

namespace {

struct StepListener : RTC::PortConnectListener {
    StepListener(std::string& s, const char* n) : events(s), name(n) {}
    void operator()(const char* port, RTC::ConnectorProfile&) override {
        events += name + "(" + (port + std::string(port).rfind('.') + 1) + ") ";
    }
    std::string& events;
    std::string name;
};
struct StepResultListener : RTC::PortConnectRetListener {
    StepResultListener(std::string& s, const char* n) : events(s), name(n) {}
    void operator()(const char*, RTC::ConnectorProfile&, RTC::ReturnCode_t ret) override {
        events += name + (ret == RTC::RTC_OK ? " " : "! ");
    }
    std::string& events;
    std::string name;
};

} // namespace

TEST_CASE("The steps of a connection are reported in order") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    std::string events;
    using T = RTC::PortConnectListenerType;
    using R = RTC::PortConnectRetListenerType;
    auto& port = counter.out_;
    port.addPortConnectListener(T::ON_NOTIFY_CONNECT, new StepListener(events, "notify"));
    port.addPortConnectListener(T::ON_NOTIFY_DISCONNECT, new StepListener(events, "leave"));
    port.addPortConnectListener(T::ON_UNSUBSCRIBE_INTERFACES, new StepListener(events, "unsubscribe"));
    port.addPortConnectRetListener(R::ON_PUBLISH_INTERFACES, new StepResultListener(events, "publish"));
    port.addPortConnectRetListener(R::ON_CONNECT_NEXTPORT, new StepResultListener(events, "next"));
    port.addPortConnectRetListener(R::ON_SUBSCRIBE_INTERFACES, new StepResultListener(events, "subscribe"));
    port.addPortConnectRetListener(R::ON_CONNECTED, new StepResultListener(events, "connected"));
    port.addPortConnectRetListener(R::ON_DISCONNECT_NEXT, new StepResultListener(events, "unnext"));
    port.addPortConnectRetListener(R::ON_DISCONNECTED, new StepResultListener(events, "disconnected"));
    fixture.connect("Counter0.out?port=Accumulator0.in");
    CHECK(std::exchange(events, "") == "notify(out) publish next subscribe connected ");
    port.disconnect_all();
    CHECK(std::exchange(events, "") == "leave(out) unnext unsubscribe(out) disconnected ");
    CHECK_THROWS(fixture.connect("Counter0.out?port=Accumulator0.in&buffer_type=none"));
    CHECK(events.find("next! subscribe! connected! ") != std::string::npos);
}

namespace {

struct DoublingConverter : RTC::OnWriteConvert<RTC::TimedLong>, RTC::OnReadConvert<RTC::TimedLong> {
    RTC::TimedLong operator()(const RTC::TimedLong& value) override {
        RTC::TimedLong twice(value);
        twice.data *= 2;
        return twice;
    }
};
struct CountingCallback : RTC::OnWrite<RTC::TimedLong>, RTC::OnRead<RTC::TimedLong> {
    void operator()(const RTC::TimedLong& value) override { written += value.data; }
    void operator()() override { ++reads; }
    long written = 0, reads = 0;
};

} // namespace

TEST_CASE("The callbacks of ports see and change what is written and read") {
    const std::string interface = GENERATE("corba_cdr", "direct");
    static ManagerFixture fixture;
    static auto& counter = fixture.create<Counter>("Counter");
    static auto& accumulator = fixture.create<Accumulator>("Accumulator");
    counter.out_.disconnect_all();
    fixture.connect("Counter0.out?port=Accumulator0.in&interface_type=" + interface);
    DoublingConverter converter;
    CountingCallback callback;
    counter.out_.setOnWrite(&callback);
    counter.out_.setOnWriteConvert(&converter);
    accumulator.in_.setOnRead(&callback);
    accumulator.in_.setOnReadConvert(&converter);
    counter.value_.data = 3;
    REQUIRE(counter.out_.write());
    REQUIRE(accumulator.in_.isNew("Counter0.out-Accumulator0.in"));
    CHECK_FALSE(accumulator.in_.isNew("another"));
    REQUIRE(accumulator.in_.read("Counter0.out-Accumulator0.in"));
    CHECK(accumulator.in_.getStatus(0) == RTC::DataPortStatus::PORT_OK);
    CHECK(accumulator.value_.data == 12);
    CHECK(counter.value_.data == 3);
    CHECK(callback.written == 3);
    CHECK(callback.reads == 1);
    counter.out_.setOnWrite(nullptr);
    counter.out_.setOnWriteConvert(nullptr);
    accumulator.in_.setOnRead(nullptr);
    accumulator.in_.setOnReadConvert(nullptr);
}

namespace {

struct PreActionListener : RTC::PreComponentActionListener {
    explicit PreActionListener(std::string& s) : events(s) {}
    void operator()(RTC::UniqueId) override { events += "<"; }
    std::string& events;
};
struct PostActionListener : RTC::PostComponentActionListener {
    explicit PostActionListener(std::string& s) : events(s) {}
    void operator()(RTC::UniqueId, RTC::ReturnCode_t ret) override {
        events += ret == RTC::RTC_OK ? ">" : "!";
    }
    std::string& events;
};

} // namespace

TEST_CASE("Listeners of component actions are called before and after each of them") {
    ManagerFixture fixture;
    auto& rtc = fixture.create<Recorder>("Recorder");
    std::string events;
    for (int i = 0;
         i < static_cast<int>(RTC::PreComponentActionListenerType::PRE_COMPONENT_ACTION_LISTENER_NUM); ++i) {
        rtc.addPreComponentActionListener(static_cast<RTC::PreComponentActionListenerType>(i),
                                          new PreActionListener(events));
        rtc.addPostComponentActionListener(static_cast<RTC::PostComponentActionListenerType>(i),
                                           new PostActionListener(events));
    }
    fixture.activate(rtc);
    fixture.step(rtc);
    CHECK(std::exchange(events, "") == "<><><>");
    Recorder::failing_callback() = "execute";
    fixture.step(rtc);
    CHECK(std::exchange(events, "") == "<!");
    fixture.step(rtc);
    CHECK(std::exchange(events, "") == "<><><>"); // deactivated, aborting, error
    rtc.setExecutionRate(0, 10);
    CHECK(std::exchange(events, "") == "<>");
    Recorder::failing_callback() = "";
    rtc.reset(0);
    CHECK(std::exchange(events, "") == "<>");
    rtc.exit();
    CHECK(events == "<><>"); // shutdown, finalize
}

TEST_CASE(
    "listeners of a component hear the connections of all its ports and its member functions can listen") {
    struct Listening : Counter {
        explicit Listening(RTC::Manager* manager) : Counter(manager) {}
        void connecting(const char* port, RTC::ConnectorProfile& profile) {
            events += std::string(port) + " by " + static_cast<const char*>(profile.name) + ";";
        }
        void connected(const char* port, RTC::ConnectorProfile&, RTC::ReturnCode_t ret) {
            events += std::string(port) + (ret == RTC::RTC_OK ? " ok;" : " refused;");
        }
        void activated(RTC::UniqueId id, RTC::ReturnCode_t ret) {
            events += "activated " + std::to_string(id) + (ret == RTC::RTC_OK ? " ok;" : " failed;");
        }
        std::string events;
    };
    ManagerFixture fixture;
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Listening");
    fixture.manager().registerFactory(profile, RTC::Create<Listening>, RTC::Delete<Listening>);
    auto& listening = fixture.create<Listening>("Listening");
    auto* listener =
        listening.addPortConnectListener(RTC::ON_NOTIFY_CONNECT, listening, &Listening::connecting);
    listening.addPortConnectRetListener(RTC::ON_CONNECTED, listening, &Listening::connected);
    listening.addPostComponentActionListener(RTC::POST_ON_ACTIVATED, listening, &Listening::activated);
    fixture.create<Accumulator>("Accumulator");
    fixture.create<Accumulator>("Accumulator");

    fixture.connect("Listening0.out?port=Accumulator0.in");
    CHECK(std::exchange(listening.events, "") ==
          "Listening0.out by Listening0.out-Accumulator0.in;Listening0.out ok;");
    listening.removePortConnectListener(RTC::ON_NOTIFY_CONNECT, listener);
    fixture.connect("Listening0.out?port=Accumulator1.in");
    CHECK(std::exchange(listening.events, "") == "Listening0.out ok;");
    ManagerFixture::activate(listening);
    CHECK(listening.events == "activated 0 ok;");
}

TEST_CASE("kinds of listeners have their names") {
    CHECK(std::string(RTC::PreComponentActionListener::toString(RTC::PRE_ON_STATE_UPDATE)) ==
          "PRE_ON_STATE_UPDATE");
    CHECK(std::string(RTC::PostComponentActionListener::toString(RTC::POST_ON_RATE_CHANGED)) ==
          "POST_ON_RATE_CHANGED");
    CHECK(std::string(RTC::PortActionListener::toString(RTC::REMOVE_PORT)) == "REMOVE_PORT");
    CHECK(std::string(RTC::ConfigurationSetNameListener::toString(RTC::ON_ACTIVATE_CONFIG_SET)) ==
          "ON_ACTIVATE_CONFIG_SET");
    CHECK(std::string(RTC::PortConnectRetListener::toString(RTC::ON_DISCONNECTED)) == "ON_DISCONNECTED");
    CHECK(std::string(RTC::PortConnectListener::toString(RTC::PORT_CONNECT_LISTENER_NUM)).empty());
}

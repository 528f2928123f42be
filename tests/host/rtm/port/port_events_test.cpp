// SPDX-License-Identifier: Apache-2.0
// Who is told of what: connectors, connections, component actions, configuration; and the callbacks of ports.
#include "tests/host/rtm/manager_fixture.hpp"

using namespace testing;

namespace {

using Words = std::vector<std::string>;

std::mutex story_mutex; // publishers have threads of their own

struct DataEvent : RTC::ConnectorDataListener {
    USE_CONNLISTENER_STATUS;
    DataEvent(std::string& s, const char* n) : story(s), name(n) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData&, const std::string&) override {
        std::lock_guard<std::mutex> lock(story_mutex);
        story += name + " ";
        return NO_CHANGE;
    }
    std::string& story;
    std::string name;
};
struct InfoEvent : RTC::ConnectorListener {
    USE_CONNLISTENER_STATUS;
    InfoEvent(std::string& s, const char* n) : story(s), name(n) {}
    ReturnCode operator()(RTC::ConnectorInfo&) override {
        std::lock_guard<std::mutex> lock(story_mutex);
        story += name + " ";
        return NO_CHANGE;
    }
    std::string& story;
    std::string name;
};

template <class Port>
void hear_all(Port& port, std::string& story) {
    for (int i = 0; i < static_cast<int>(RTC::ConnectorDataListenerType::CONNECTOR_DATA_LISTENER_NUM); ++i) {
        const auto type = static_cast<RTC::ConnectorDataListenerType>(i);
        port.addConnectorDataListener(type, new DataEvent(story, RTC::ConnectorDataListener::toString(type)));
    }
    for (int i = 0; i < static_cast<int>(RTC::ConnectorListenerType::CONNECTOR_LISTENER_NUM); ++i) {
        const auto type = static_cast<RTC::ConnectorListenerType>(i);
        port.addConnectorListener(type, new InfoEvent(story, RTC::ConnectorListener::toString(type)));
    }
}

struct Ends {
    std::string out, in;
    Counter& counter;
    Accumulator& accumulator;
    Ends(ManagerFixture& fixture, const std::string& properties)
        : counter(fixture.create<Counter>("Counter")),
          accumulator(fixture.create<Accumulator>("Accumulator")) {
        hear_all(counter.out_, out);
        hear_all(accumulator.in_, in);
        fixture.connect("Counter0.out?port=Accumulator0.in&" + properties);
    }
    ~Ends() {
        counter.exit();
        accumulator.exit();
        RTC::Manager::instance().cleanupComponents();
    }
    Words take() {
        std::lock_guard<std::mutex> lock(story_mutex);
        return {std::exchange(out, ""), std::exchange(in, "")};
    }
};

} // namespace

TEST_CASE("A flush connection tells of sending and receiving, and of what the buffer does") {
    const std::string interface = GENERATE("corba_cdr", "direct");
    static ManagerFixture fixture;
    CAPTURE(interface);
    Ends ends(fixture,
              "buffer.length=2&buffer.write.full_policy=do_nothing&buffer.read.empty_policy=do_nothing"
              "&interface_type=" +
                  interface);
    CHECK(ends.take() == Words{"ON_CONNECT ", "ON_CONNECT "});
    ends.counter.out_.write();
    CHECK(ends.take() == Words{"ON_SEND ON_RECEIVED ", "ON_RECEIVED ON_BUFFER_WRITE "});
    ends.counter.out_.write();
    ends.take();
    CHECK_FALSE(ends.counter.out_.write());
    CHECK(ends.take()[0] == "ON_SEND ON_RECEIVER_FULL ");
    ends.accumulator.in_.read();
    CHECK(ends.take() == Words{"", "ON_BUFFER_READ "});
    ends.accumulator.in_.read();
    ends.take();
    ends.accumulator.in_.read();
    CHECK(ends.take() == Words{"", "ON_BUFFER_EMPTY "});
    ends.accumulator.in_.disconnect_all();
    CHECK(ends.take() == Words{"ON_DISCONNECT ", "ON_DISCONNECT "});
}

TEST_CASE("A buffer that overwrites or times out says so") {
    const std::string interface = GENERATE("corba_cdr", "direct");
    static ManagerFixture fixture;
    CAPTURE(interface);
    {
        Ends ends(fixture, "buffer.length=1&interface_type=" + interface);
        ends.counter.out_.write();
        ends.take();
        ends.counter.out_.write();
        CHECK(ends.take()[1].find("ON_BUFFER_OVERWRITE") != std::string::npos);
    }
    Ends ends(fixture, "buffer.length=1&buffer.write.full_policy=block&buffer.write.timeout=0.001&"
                       "buffer.read.empty_policy=block&buffer.read.timeout=0.001&interface_type=" +
                           interface);
    ends.counter.out_.write();
    ends.take();
    CHECK_FALSE(ends.counter.out_.write());
    const Words late = ends.take();
    CHECK(late[0] == "ON_SEND ON_RECEIVER_TIMEOUT ");
    CHECK(late[1].find("ON_BUFFER_WRITE_TIMEOUT") != std::string::npos);
    ends.accumulator.in_.read();
    ends.take();
    CHECK_FALSE(ends.accumulator.in_.read());
    CHECK(ends.take()[1] == "ON_BUFFER_READ_TIMEOUT ");
}

TEST_CASE("A pull connection tells of its buffer on the sending side") {
    ManagerFixture fixture;
    Ends ends(fixture, "dataflow_type=pull&buffer.read.empty_policy=do_nothing");
    ends.take();
    ends.counter.out_.write();
    CHECK(ends.take() == Words{"ON_BUFFER_WRITE ", ""});
    ends.accumulator.in_.read();
    CHECK(ends.take() == Words{"ON_BUFFER_READ ON_SEND ", "ON_RECEIVED "});
    ends.accumulator.in_.read();
    CHECK(ends.take()[0] == "ON_BUFFER_EMPTY ON_SENDER_EMPTY ");
}

namespace {

// What comes of 1 ... 6 through a publisher, in the order of its coming.
std::vector<long> published(ManagerFixture& fixture, const std::string& properties, std::size_t at_least) {
    Ends ends(fixture, "buffer.length=16&" + properties);
    for (ends.counter.value_.data = 1; ends.counter.value_.data <= 6; ++ends.counter.value_.data)
        REQUIRE(ends.counter.out_.write());
    std::vector<long> got;
    for (int i = 0; i < 3000 && got.size() < at_least; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        while (ends.accumulator.in_.isNew() && ends.accumulator.in_.read())
            got.push_back(ends.accumulator.value_.data);
    }
    return got;
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

TEST_CASE("A subscription to new data loses none when all are to be sent") {
    ManagerFixture fixture;
    CHECK(published(fixture, "subscription_type=new&publisher.push_policy=all", 6) ==
          std::vector<long>{1, 2, 3, 4, 5, 6});
    CHECK(published(fixture, "subscription_type=new", 1).back() <= 6);
}

namespace {

struct Step : RTC::PortConnectListener {
    Step(std::string& s, const char* n) : story(s), name(n) {}
    void operator()(const char* port, RTC::ConnectorProfile&) override {
        story += name + "(" + (port + std::string(port).rfind('.') + 1) + ") ";
    }
    std::string& story;
    std::string name;
};
struct RetStep : RTC::PortConnectRetListener {
    RetStep(std::string& s, const char* n) : story(s), name(n) {}
    void operator()(const char*, RTC::ConnectorProfile&, RTC::ReturnCode_t ret) override {
        story += name + (ret == RTC::RTC_OK ? " " : "! ");
    }
    std::string& story;
    std::string name;
};

} // namespace

TEST_CASE("The steps of a connection are told in order") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    std::string story;
    using T = RTC::PortConnectListenerType;
    using R = RTC::PortConnectRetListenerType;
    auto& port = counter.out_;
    port.addPortConnectListener(T::ON_NOTIFY_CONNECT, new Step(story, "notify"));
    port.addPortConnectListener(T::ON_NOTIFY_DISCONNECT, new Step(story, "leave"));
    port.addPortConnectListener(T::ON_UNSUBSCRIBE_INTERFACES, new Step(story, "unsubscribe"));
    port.addPortConnectRetListener(R::ON_PUBLISH_INTERFACES, new RetStep(story, "publish"));
    port.addPortConnectRetListener(R::ON_CONNECT_NEXTPORT, new RetStep(story, "next"));
    port.addPortConnectRetListener(R::ON_SUBSCRIBE_INTERFACES, new RetStep(story, "subscribe"));
    port.addPortConnectRetListener(R::ON_CONNECTED, new RetStep(story, "connected"));
    port.addPortConnectRetListener(R::ON_DISCONNECT_NEXT, new RetStep(story, "unnext"));
    port.addPortConnectRetListener(R::ON_DISCONNECTED, new RetStep(story, "disconnected"));
    fixture.connect("Counter0.out?port=Accumulator0.in");
    CHECK(std::exchange(story, "") == "notify(out) publish next subscribe connected ");
    port.disconnect_all();
    CHECK(std::exchange(story, "") == "leave(out) unnext unsubscribe(out) disconnected ");
    CHECK_THROWS(fixture.connect("Counter0.out?port=Accumulator0.in&buffer_type=none"));
    CHECK(story.find("next! subscribe! connected! ") != std::string::npos);
}

namespace {

struct Doubled : RTC::OnWriteConvert<RTC::TimedLong>, RTC::OnReadConvert<RTC::TimedLong> {
    RTC::TimedLong operator()(const RTC::TimedLong& value) override {
        RTC::TimedLong twice(value);
        twice.data *= 2;
        return twice;
    }
};
struct Noted : RTC::OnWrite<RTC::TimedLong>, RTC::OnRead<RTC::TimedLong> {
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
    Doubled doubled;
    Noted noted;
    counter.out_.setOnWrite(&noted);
    counter.out_.setOnWriteConvert(&doubled);
    accumulator.in_.setOnRead(&noted);
    accumulator.in_.setOnReadConvert(&doubled);
    counter.value_.data = 3;
    REQUIRE(counter.out_.write());
    REQUIRE(accumulator.in_.isNew("Counter0.out-Accumulator0.in"));
    CHECK_FALSE(accumulator.in_.isNew("another"));
    REQUIRE(accumulator.in_.read("Counter0.out-Accumulator0.in"));
    CHECK(accumulator.in_.getStatus(0) == RTC::DataPortStatus::PORT_OK);
    CHECK(accumulator.value_.data == 12);
    CHECK(counter.value_.data == 3);
    CHECK(noted.written == 3);
    CHECK(noted.reads == 1);
    counter.out_.setOnWrite(nullptr);
    counter.out_.setOnWriteConvert(nullptr);
    accumulator.in_.setOnRead(nullptr);
    accumulator.in_.setOnReadConvert(nullptr);
}

namespace {

struct Before : RTC::PreComponentActionListener {
    explicit Before(std::string& s) : story(s) {}
    void operator()(RTC::UniqueId) override { story += "<"; }
    std::string& story;
};
struct After : RTC::PostComponentActionListener {
    explicit After(std::string& s) : story(s) {}
    void operator()(RTC::UniqueId, RTC::ReturnCode_t ret) override {
        story += ret == RTC::RTC_OK ? ">" : "!";
    }
    std::string& story;
};

} // namespace

TEST_CASE("Listeners of component actions are called before and after each of them") {
    ManagerFixture fixture;
    auto& rtc = fixture.create<Recorder>("Recorder");
    std::string story;
    for (int i = 0;
         i < static_cast<int>(RTC::PreComponentActionListenerType::PRE_COMPONENT_ACTION_LISTENER_NUM); ++i) {
        rtc.addPreComponentActionListener(static_cast<RTC::PreComponentActionListenerType>(i),
                                          new Before(story));
        rtc.addPostComponentActionListener(static_cast<RTC::PostComponentActionListenerType>(i),
                                           new After(story));
    }
    fixture.activate(rtc);
    fixture.step(rtc);
    CHECK(std::exchange(story, "") == "<><><>");
    Recorder::failing_callback() = "execute";
    fixture.step(rtc);
    CHECK(std::exchange(story, "") == "<!");
    fixture.step(rtc);
    CHECK(std::exchange(story, "") == "<><><>"); // deactivated, aborting, error
    rtc.setExecutionRate(0, 10);
    CHECK(std::exchange(story, "") == "<>");
    Recorder::failing_callback() = "";
    rtc.reset(0);
    CHECK(std::exchange(story, "") == "<>");
    rtc.exit();
    CHECK(story == "<><>"); // shutdown, finalize
}

TEST_CASE(
    "listeners of a component hear the connections of all its ports and its member functions can listen") {
    struct Listening : Counter {
        explicit Listening(RTC::Manager* manager) : Counter(manager) {}
        void connecting(const char* port, RTC::ConnectorProfile& profile) {
            story += std::string(port) + " by " + static_cast<const char*>(profile.name) + ";";
        }
        void connected(const char* port, RTC::ConnectorProfile&, RTC::ReturnCode_t ret) {
            story += std::string(port) + (ret == RTC::RTC_OK ? " ok;" : " refused;");
        }
        void activated(RTC::UniqueId id, RTC::ReturnCode_t ret) {
            story += "activated " + std::to_string(id) + (ret == RTC::RTC_OK ? " ok;" : " failed;");
        }
        std::string story;
    };
    ManagerFixture fixture;
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Listening");
    fixture.manager().registerFactory(profile, RTC::Create<Listening>, RTC::Delete<Listening>);
    auto& listening = fixture.create<Listening>("Listening");
    auto* hears = listening.addPortConnectListener(RTC::ON_NOTIFY_CONNECT, listening, &Listening::connecting);
    listening.addPortConnectRetListener(RTC::ON_CONNECTED, listening, &Listening::connected);
    listening.addPostComponentActionListener(RTC::POST_ON_ACTIVATED, listening, &Listening::activated);
    fixture.create<Accumulator>("Accumulator");
    fixture.create<Accumulator>("Accumulator");

    fixture.connect("Listening0.out?port=Accumulator0.in");
    CHECK(std::exchange(listening.story, "") ==
          "Listening0.out by Listening0.out-Accumulator0.in;Listening0.out ok;");
    listening.removePortConnectListener(RTC::ON_NOTIFY_CONNECT, hears);
    fixture.connect("Listening0.out?port=Accumulator1.in");
    CHECK(std::exchange(listening.story, "") == "Listening0.out ok;");
    ManagerFixture::activate(listening);
    CHECK(listening.story == "activated 0 ok;");
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

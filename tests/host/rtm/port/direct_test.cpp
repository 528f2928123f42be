// SPDX-License-Identifier: Apache-2.0
// The interface type direct: values from port to port within the process.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/support/allocations.hpp"

using namespace testing;

namespace {

template <class T>
struct Pair {
    T sent{}, received{};
    RTC::OutPort<T> out{"a", sent};
    RTC::InPort<T> in{"b", received};
    RTC::RTObject_impl& owner;
    Pair(ManagerFixture& fixture, const std::string& properties)
        : owner(fixture.create<Recorder>("Recorder")) {
        owner.addOutPort("a", out);
        owner.addInPort("b", in);
        fixture.connect("Recorder0.a?port=Recorder0.b&" + properties);
    }
    ~Pair() { // before cleanupComponents(), which deletes the owner
        owner.removePort(out);
        owner.removePort(in);
    }
};

long allocations_of(const std::function<void()>& once) {
    for (int i = 0; i < 100; ++i) once();
    const long before = allocations();
    for (int i = 0; i < 1000; ++i) once();
    return allocations() - before;
}

} // namespace

TEST_CASE("Within the process values of fixed size are written and read without allocation") {
    const std::string interface = GENERATE("direct", "corba_cdr");
    static ManagerFixture fixture;
    CAPTURE(interface);
    {
        Pair<RTC::TimedLong> pair(fixture, "interface_type=" + interface);
        CHECK(allocations_of([&] {
                  pair.sent.data++;
                  if (!pair.out.write() || !pair.in.isNew() || !pair.in.read())
                      throw std::runtime_error("lost");
              }) == 0);
        CHECK(pair.received.data == 1100);
        pair.owner.exit();
    }
    fixture.manager().cleanupComponents();
    {
        Pair<RTC::TimedDoubleSeq> pair(fixture, "interface_type=" + interface);
        pair.sent.data.length(3);
        pair.sent.data[2] = 0;
        CHECK(allocations_of([&] {
                  pair.sent.data[2] += 0.5;
                  if (!pair.out.write() || !pair.in.isNew() || !pair.in.read())
                      throw std::runtime_error("lost");
              }) == 0);
        CHECK(pair.received.data[2] == 550);
        pair.owner.exit();
    }
    fixture.manager().cleanupComponents();
}

TEST_CASE("A direct connection keeps the buffer's policies") {
    const auto row = GENERATE(std::pair("overwrite", std::vector<long>{2, 3}),
                              std::pair("do_nothing", std::vector<long>{1, 2}),
                              std::pair("block&buffer.write.timeout=0.001", std::vector<long>{1, 2}));
    static ManagerFixture fixture;
    {
        Pair<RTC::TimedLong> pair(fixture,
                                  std::string("interface_type=direct&buffer.length=2&buffer.read.empty_"
                                              "policy=do_nothing&buffer.write.full_policy=") +
                                      row.first);
        for (pair.sent.data = 1; pair.sent.data <= 2; ++pair.sent.data) CHECK(pair.out.write());
        CHECK(pair.out.write() == (std::string(row.first) == "overwrite"));
        std::vector<long> got;
        while (pair.in.isNew() && pair.in.read()) got.push_back(pair.received.data);
        CHECK(got == row.second);
        CHECK_FALSE(pair.in.read());
        pair.owner.exit();
    }
    fixture.manager().cleanupComponents();
}

namespace {

struct AddHundred : RTC::ConnectorDataListenerT<RTC::TimedLong> {
    USE_CONNLISTENER_STATUS;
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedLong& data) override {
        data.data += 100;
        return DATA_CHANGED;
    }
};

} // namespace

TEST_CASE("Listeners hear the values of a direct connection and may change them") {
    ManagerFixture fixture;
    Pair<RTC::TimedLong> pair(fixture, "interface_type=direct");
    auto* received = new AddHundred;
    auto* read = new AddHundred;
    pair.in.addConnectorDataListener(RTC::ON_RECEIVED, received);
    pair.sent.data = 1;
    REQUIRE(pair.out.write());
    pair.in.addConnectorDataListener(RTC::ON_BUFFER_READ, read);
    REQUIRE(pair.in.read());
    CHECK(pair.received.data == 201);
    pair.in.removeConnectorDataListener(RTC::ON_RECEIVED, received);
    pair.in.removeConnectorDataListener(RTC::ON_BUFFER_READ, read);
    REQUIRE(pair.out.write());
    REQUIRE(pair.in.read());
    CHECK(pair.received.data == 1);
}

TEST_CASE("An OutPort may have direct connections beside others") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& a = fixture.create<Accumulator>("Accumulator");
    auto& b = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&interface_type=direct");
    fixture.connect("Counter0.out?port=Accumulator1.in");
    for (counter.value_.data = 1; counter.value_.data <= 5; ++counter.value_.data)
        REQUIRE(counter.out_.write());
    for (auto* accumulator : {&a, &b}) {
        fixture.activate(*accumulator);
        fixture.step(*accumulator);
        CHECK(accumulator->sum_ == 15);
    }
    CHECK(a.in_.disconnect_all() == RTC::RTC_OK);
    CHECK(counter.out_.write());
    CHECK_FALSE(a.in_.isNew());
}

TEST_CASE("A time-stamp policy works on a direct connection as on any other") {
    const std::string policy = GENERATE("on_write", "on_send", "on_received", "on_read");
    static ManagerFixture fixture;
    {
        Pair<RTC::TimedLong> pair(fixture, "interface_type=direct&timestamp_policy=" + policy);
        REQUIRE(pair.out.write());
        REQUIRE(pair.in.read());
        CHECK(pair.received.tm.sec > 1000000000u);
        CHECK(pair.sent.tm.sec == 0);
        pair.owner.exit();
    }
    fixture.manager().cleanupComponents();
}

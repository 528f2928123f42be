// SPDX-License-Identifier: Apache-2.0
// One OutPort with several readers: a message is encoded once.
#include "tests/host/rtm/manager_fixture.hpp"
#include <memory>

using namespace testing;

namespace {

/// A value that counts how often it is encoded and copied.
struct CountedPose : RTC::TimedPose2D {
    CountedPose() : RTC::TimedPose2D() {}
    CountedPose(const CountedPose& other) : RTC::TimedPose2D(other) { ++copies; }
    CountedPose& operator=(const CountedPose& other) {
        RTC::TimedPose2D::operator=(other);
        ++copies;
        return *this;
    }
    void operator>>=(cdrStream& out) const {
        ++encodings;
        RTC::TimedPose2D::operator>>=(out);
    }
    static inline int encodings = 0, copies = 0;
};

/// A reader of the port `out` of Counter0.
struct Reader {
    Reader(ManagerFixture& fixture, RTC::RTObject_impl& rtc, const std::string& name,
           const std::string& properties)
        : in(name.c_str(), value) {
        rtc.addInPort(name.c_str(), in);
        fixture.connect("Counter0.pose_out?port=Counter0." + name + properties);
    }
    CountedPose value;
    RTC::InPort<CountedPose> in;
};

struct Readers {
    Readers() : out("pose_out", sent) { rtc.addOutPort("pose_out", out); }
    void add(const std::string& properties) {
        all.push_back(std::make_unique<Reader>(fixture, rtc, "in" + std::to_string(all.size()), properties));
    }
    ~Readers() {
        rtc.removePort(out);
        for (auto& reader : all) rtc.removePort(reader->in);
    }
    /// Sends a value, and checks that each reader gets it.
    void send(double x) {
        sent.data.position.x = x;
        REQUIRE(out.write());
        for (auto& reader : all) {
            REQUIRE(reader->in.read());
            CHECK(reader->value.data.position.x == x);
        }
    }

    ManagerFixture fixture;
    Counter& rtc = fixture.create<Counter>("Counter");
    CountedPose sent;
    RTC::OutPort<CountedPose> out;
    std::vector<std::unique_ptr<Reader>> all;
};

} // namespace

TEST_CASE("A message to several readers is encoded once") {
    Readers readers;
    for (const std::size_t count : {1U, 2U, 4U, 8U, 16U}) {
        while (readers.all.size() < count) readers.add("");
        readers.send(1); // each buffer gets its memory
        CountedPose::encodings = 0;
        readers.send(2);
        CHECK(CountedPose::encodings == 1);
    }
}

TEST_CASE(
    "A message to direct readers is copied once for each when written, and encoded once for all others") {
    Readers readers;
    for (int i = 0; i < 2; ++i)
        for (const auto* properties : {"&interface_type=direct", "", "&subscription_type=new"})
            readers.add(properties);
    readers.sent.data.position.x = 1;
    REQUIRE(readers.out.write());
    CountedPose::encodings = CountedPose::copies = 0;
    REQUIRE(readers.out.write());
    CHECK(CountedPose::encodings == 1);
    CHECK(CountedPose::copies == 2);
}

TEST_CASE("A reader whose listener gets the bytes does not make the others' message be encoded again") {
    struct Listener : RTC::ConnectorDataListener {
        using RTC::ConnectorDataListener::operator();
        ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData&, const std::string&) override {
            ++calls;
            return NO_CHANGE;
        }
        int calls = 0;
    } listener;
    Readers readers;
    for (const auto* properties : {"&interface_type=direct", "", "&interface_type=direct"})
        readers.add(properties);
    readers.all[1]->in.addConnectorDataListener(RTC::ON_RECEIVED, &listener, false);
    readers.send(1);
    CountedPose::encodings = 0;
    readers.send(2);
    CHECK(CountedPose::encodings == 1);
    CHECK(listener.calls == 2);
    readers.all[1]->in.removeConnectorDataListener(RTC::ON_RECEIVED, &listener);
}

// SPDX-License-Identifier: Apache-2.0
// The interface type direct: values from port to port within the process.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/check_copies.hpp"

#include <algorithm>
#include <functional>
#include <set>

using namespace testing;

namespace {

template <class T>
struct PortPair {
    T sent{}, received{};
    RTC::OutPort<T> out{"a", sent};
    RTC::InPort<T> in{"b", received};
    RTC::RTObject_impl& owner;
    PortPair(ManagerFixture& fixture, const std::string& properties)
        : owner(fixture.create<Recorder>("Recorder")) {
        owner.addOutPort("a", out);
        owner.addInPort("b", in);
        fixture.connect("Recorder0.a?port=Recorder0.b&" + properties);
    }
    ~PortPair() { // before cleanupComponents(), which deletes the owner
        owner.removePort(out);
        owner.removePort(in);
    }
};

long count_allocations(const std::function<void()>& operation) {
    for (int i = 0; i < 100; ++i) operation();
    const long before = allocations();
    for (int i = 0; i < 1000; ++i) operation();
    return allocations() - before;
}

} // namespace

TEST_CASE("Within the process values of fixed size are written and read without allocation") {
    const std::string interface = GENERATE("direct", "corba_cdr");
    static ManagerFixture fixture;
    CAPTURE(interface);
    {
        PortPair<RTC::TimedLong> ports(fixture, "interface_type=" + interface);
        CHECK(count_allocations([&] {
                  ports.sent.data++;
                  if (!ports.out.write() || !ports.in.isNew() || !ports.in.read())
                      throw std::runtime_error("lost");
              }) == 0);
        CHECK(ports.received.data == 1100);
        ports.owner.exit();
    }
    fixture.manager().cleanupComponents();
    {
        PortPair<RTC::TimedDoubleSeq> ports(fixture, "interface_type=" + interface);
        ports.sent.data.length(3);
        ports.sent.data[2] = 0;
        CHECK(count_allocations([&] {
                  ports.sent.data[2] += 0.5;
                  if (!ports.out.write() || !ports.in.isNew() || !ports.in.read())
                      throw std::runtime_error("lost");
              }) == 0);
        CHECK(ports.received.data[2] == 550);
        ports.owner.exit();
    }
    fixture.manager().cleanupComponents();
}

TEST_CASE("A direct connection keeps the buffer's policies") {
    const auto row = GENERATE(std::pair("overwrite", std::vector<long>{2, 3}),
                              std::pair("do_nothing", std::vector<long>{1, 2}),
                              std::pair("block&buffer.write.timeout=0.001", std::vector<long>{1, 2}));
    static ManagerFixture fixture;
    {
        PortPair<RTC::TimedLong> ports(fixture,
                                       std::string("interface_type=direct&buffer.length=2&buffer.read.empty_"
                                                   "policy=do_nothing&buffer.write.full_policy=") +
                                           row.first);
        for (ports.sent.data = 1; ports.sent.data <= 2; ++ports.sent.data) CHECK(ports.out.write());
        CHECK(ports.out.write() == (std::string(row.first) == "overwrite"));
        std::vector<long> values_read;
        while (ports.in.isNew() && ports.in.read()) values_read.push_back(ports.received.data);
        CHECK(values_read == row.second);
        CHECK_FALSE(ports.in.read());
        ports.owner.exit();
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
    PortPair<RTC::TimedLong> ports(fixture, "interface_type=direct");
    auto* received = new AddHundred;
    auto* read = new AddHundred;
    ports.in.addConnectorDataListener(RTC::ON_RECEIVED, received);
    ports.sent.data = 1;
    REQUIRE(ports.out.write());
    ports.in.addConnectorDataListener(RTC::ON_BUFFER_READ, read);
    REQUIRE(ports.in.read());
    CHECK(ports.received.data == 201);
    ports.in.removeConnectorDataListener(RTC::ON_RECEIVED, received);
    ports.in.removeConnectorDataListener(RTC::ON_BUFFER_READ, read);
    REQUIRE(ports.out.write());
    REQUIRE(ports.in.read());
    CHECK(ports.received.data == 1);
}

namespace {

struct LookAt : RTC::ConnectorDataListenerT<RTC::TimedOctetSeq> {
    const RTC::TimedOctetSeq* seen = nullptr;
    std::function<void()> on_call = [] {};
    void operator()(const RTC::ConnectorInfo&, const RTC::TimedOctetSeq& data) override {
        seen = &data;
        on_call();
    }
};
struct LookAtBytes : RTC::ConnectorDataListener {
    unsigned long length = 0;
    void operator()(const RTC::ConnectorInfo&, const cdrMemoryStream& data) override {
        length = data.bufSize();
    }
};

} // namespace

TEST_CASE("A listener to the values of a direct connection gets them without serialization and without "
          "allocation") {
    ManagerFixture fixture;
    PortPair<RTC::TimedOctetSeq> ports(fixture, "interface_type=direct");
    auto* received = new LookAt;
    auto* stored = new LookAt;
    auto* read = new LookAt;
    ports.in.addConnectorDataListener(RTC::ON_RECEIVED, received);
    ports.in.addConnectorDataListener(RTC::ON_BUFFER_WRITE, stored);
    ports.in.addConnectorDataListener(RTC::ON_BUFFER_READ, read);
    ports.sent.data.length(100000);
    CHECK(count_allocations([&] {
              if (!ports.out.write() || !ports.in.read()) throw std::runtime_error("lost");
          }) == 0);
    CHECK(received->seen == stored->seen);
    CHECK(received->seen != &ports.sent);
    CHECK(read->seen == &ports.received);
    CHECK(received->seen->data.length() == 100000);

    // If one listener requests bytes, all messages are encoded; the other listeners still get values.
    auto* bytes = new LookAtBytes;
    ports.in.addConnectorDataListener(RTC::ON_BUFFER_WRITE, bytes);
    received->seen = nullptr;
    REQUIRE(ports.out.write());
    CHECK(bytes->length == 100000 + 12);
    CHECK(received->seen != nullptr);
}

TEST_CASE(
    "A message that a listener of a direct connection has received enters the buffer without another copy") {
    ManagerFixture fixture;
    PortPair<RTC::TimedOctetSeq> ports(fixture, "interface_type=direct");
    auto* received = new LookAt;
    ports.in.addConnectorDataListener(RTC::ON_RECEIVED, received);
    ports.sent.data.length(100000);
    const CORBA::Octet* heard = nullptr;
    for (CORBA::Octet number = 1; number <= 5; ++number) {
        ports.sent.data[99999] = number;
        received->on_call = [&] { heard = received->seen->data.NP_data(); };
        REQUIRE(ports.out.write());
        REQUIRE(ports.in.read());
        CHECK(ports.received.data.get_buffer() == heard);
        CHECK((ports.received.data.length() == 100000 && ports.received.data[99999] == number));
        CHECK(ports.sent.data.length() == 100000);
    }
}

TEST_CASE("An OutPort may have direct and other connections at the same time") {
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
        PortPair<RTC::TimedLong> ports(fixture, "interface_type=direct&timestamp_policy=" + policy);
        REQUIRE(ports.out.write());
        REQUIRE(ports.in.read());
        CHECK(ports.received.tm.sec > 1000000000u);
        CHECK(ports.sent.tm.sec == 0);
        ports.owner.exit();
    }
    fixture.manager().cleanupComponents();
}

namespace {

constexpr CORBA::ULong picture_bytes = 65536;

/// What the component does with one picture: the first byte tells them apart.
RTC::TimedOctetSeq read_picture(PortPair<RTC::TimedOctetSeq>& ports) {
    REQUIRE(ports.in.read());
    REQUIRE(ports.received.data.length() == picture_bytes);
    CHECK(ports.received.data[picture_bytes - 1] == ports.received.data[0]);
    return ports.received;
}
void write_picture(PortPair<RTC::TimedOctetSeq>& ports, CORBA::Octet number) {
    ports.sent.tm.nsec = number;
    std::fill_n(ports.sent.data.get_buffer(), picture_bytes, number);
    REQUIRE(ports.out.write());
    CHECK(ports.sent.data[0] == number);
}

} // namespace

TEST_CASE("A long sequence of a direct connection is copied once, into memory that the variable gets") {
    ManagerFixture fixture;
    PortPair<RTC::TimedOctetSeq> ports(fixture, "interface_type=direct");
    ports.sent.data.length(picture_bytes);
    std::set<const CORBA::Octet*> places;
    for (CORBA::Octet number = 1; number <= 20; ++number) {
        write_picture(ports, number);
        const auto picture = read_picture(ports);
        CHECK(picture.data[0] == number);
        CHECK(picture.tm.nsec == number);
        places.insert(ports.received.data.get_buffer());
    }
    CHECK(places.size() == 2); // the memory of the variable and of the buffer, alternately

    for (CORBA::Octet number = 21; number <= 24; ++number) write_picture(ports, number);
    for (CORBA::Octet number = 21; number <= 24; ++number) CHECK(read_picture(ports).data[0] == number);

    ports.sent.data.length(picture_bytes - 1); // short, and still whole
    REQUIRE(ports.out.write());
    REQUIRE(ports.in.read());
    CHECK(ports.received.data.length() == picture_bytes - 1);
}

TEST_CASE("While only a listener uses long values, a direct connection keeps the newest and little memory") {
    ManagerFixture fixture;
    PortPair<RTC::TimedOctetSeq> ports(fixture, "interface_type=direct");
    auto* received = new LookAt;
    std::set<const CORBA::Octet*> places;
    received->on_call = [&] { places.insert(received->seen->data.NP_data()); };
    ports.in.addConnectorDataListener(RTC::ON_RECEIVED, received);
    ports.sent.data.length(picture_bytes);
    for (CORBA::Octet number = 1; number <= 20; ++number) write_picture(ports, number);
    CHECK(places.size() == 2); // the memory of the listener and of the buffer, alternately
    CHECK(read_picture(ports).data[0] == 20);
    CHECK_FALSE(ports.in.isNew());
    for (CORBA::Octet number = 21; number <= 24; ++number) write_picture(ports, number);
    for (CORBA::Octet number = 21; number <= 24; ++number) CHECK(read_picture(ports).data[0] == number);
}

TEST_CASE("A direct connection that is read again gives its last long value again") {
    ManagerFixture fixture;
    PortPair<RTC::TimedOctetSeq> ports(fixture, "interface_type=direct");
    ports.sent.data.length(picture_bytes);
    write_picture(ports, 1);
    write_picture(ports, 2);
    for (const CORBA::Octet expected : {1, 2, 2, 2}) CHECK(read_picture(ports).data[0] == expected);
    write_picture(ports, 3);
    for (const CORBA::Octet expected : {3, 3}) CHECK(read_picture(ports).data[0] == expected);
}

TEST_CASE("A variable whose memory is not its own gets a copy of a long value") {
    ManagerFixture fixture;
    PortPair<RTC::TimedOctetSeq> ports(fixture, "interface_type=direct");
    ports.sent.data.length(picture_bytes);
    std::vector<CORBA::Octet> own(picture_bytes);
    ports.received.data.replace(picture_bytes, 0, own.data(), false);
    write_picture(ports, 7);
    CHECK(read_picture(ports).data[0] == 7);
    CHECK(own[0] == 7);
    CHECK(ports.received.data.get_buffer() == own.data());
}

TEST_CASE("The pixels of a picture are swapped, and everything else is copied") {
    RTC::CameraImage image{}, taken{};
    image.tm = {5, 6};
    image.width = 300, image.height = 100, image.bpp = 24, image.fDiv = 0.5;
    image.format = "RGB";
    image.pixels.length(90000);
    image.pixels[89999] = 77;
    const CORBA::Octet* const pixels = image.pixels.get_buffer();
    CHECK(RTC::isLong(image));
    CHECK(RTC::takeValue(taken, image));
    CHECK(taken.pixels.get_buffer() == pixels);
    CHECK((taken.pixels.length() == 90000 && taken.pixels[89999] == 77));
    CHECK((taken.tm.nsec == 6 && taken.width == 300 && taken.height == 100 && taken.bpp == 24));
    CHECK(std::string(taken.format.in()) == "RGB");
    CHECK(image.pixels.length() == 0);
    image.pixels.length(10);
    CHECK_FALSE(RTC::isLong(image));
}

namespace {

template <class Value>
Value copy_of(const Value& value, Value into = {}) {
    RTC::copyValue(into, value);
    return into;
}

} // namespace

TEST_CASE("Bytes are copied whatever the distance between their addresses") {
    tandem::test::check_copies(RTC::copyBytes);
}

TEST_CASE("Values with sequences of bytes are copied whole, over longer and shorter ones") {
    RTC::TimedOctetSeq value{};
    value.tm = {3, 4};
    value.data.length(1000);
    for (CORBA::ULong i = 0; i < 1000; ++i) value.data[i] = static_cast<CORBA::Octet>(i);
    RTC::TimedOctetSeq longer{}, shorter{};
    longer.data.length(5000);
    shorter.data.length(10);
    for (const auto& copy :
         {copy_of(value), copy_of(value, longer), copy_of(value, shorter), copy_of(value, value)}) {
        REQUIRE(copy.data.length() == 1000);
        CHECK(copy.data[999] == static_cast<CORBA::Octet>(999));
        CHECK(copy.tm.nsec == 4);
        CHECK(copy.data.get_buffer() != value.data.get_buffer());
    }
    RTC::copyValue(value, value);
    CHECK(value.data.length() == 1000);
    CHECK(copy_of(RTC::TimedOctetSeq{}, longer).data.length() == 0);

    RTC::CameraImage image{};
    image.tm = {5, 6};
    image.width = 2, image.height = 1, image.bpp = 24, image.fDiv = 0.5;
    image.format = "RGB";
    image.pixels.length(6);
    image.pixels[5] = 77;
    const RTC::CameraImage copy = copy_of(image);
    CHECK(copy.tm.sec == 5);
    CHECK((copy.width == 2 && copy.height == 1 && copy.bpp == 24 && copy.fDiv == 0.5));
    CHECK(std::string(copy.format.in()) == "RGB");
    REQUIRE(copy.pixels.length() == 6);
    CHECK(copy.pixels[5] == 77);
}

// SPDX-License-Identifier: Apache-2.0
// Long messages in a buffer that lets them be made and read where they lie.
#include "tests/host/rtm/manager_fixture.hpp"
#include <deque>
#include <rtm/CdrRingBuffer.h>
#include <rtm/InPlaceBuffer.h>

using namespace testing;

namespace {

/// As a bridge's shared memory would be, and counts which way messages came and went.
struct Place : RTC::CdrRingBuffer, RTC::InPlaceBuffer {
    static constexpr std::size_t long_from = 10'000;
    struct Counts {
        int copied_in = 0, made = 0, copied_out = 0, shown = 0;
        bool operator==(const Counts&) const = default;
    };
    static Place*& made_last() {
        static Place* place = nullptr;
        return place;
    }
    void init(const coil::Properties&) override { made_last() = this; }

    std::size_t minInPlaceLength() const override { return long_from; }
    std::size_t readable() const override { return messages.size(); }
    bool empty() const override { return messages.empty(); }
    RTC::BufferStatus write(const RTC::ByteData& bytes, std::chrono::nanoseconds) override {
        ++counts.copied_in;
        messages.push_back({bytes, bytes.getDataLength()});
        return RTC::BufferStatus::OK;
    }
    RTC::BufferStatus writeInPlace(const RTC::Marshal& marshal) override {
        const cdrMemoryStream usual;
        cdrCountingStream counter(usual.TCS_C(), usual.TCS_W());
        if (!marshal(counter) || counter.total() < long_from) return RTC::BufferStatus::NOT_SUPPORTED;
        ++counts.made;
        if (full_now) return RTC::BufferStatus::FULL;
        cdrMemoryStream stream;
        stream.setByteSwapFlag(true);
        REQUIRE(marshal(stream));
        RTC::ByteData bytes;
        bytes.writeData(static_cast<const unsigned char*>(stream.bufPtr()), stream.bufSize());
        REQUIRE(stream.bufSize() == counter.total());
        messages.push_back({bytes, bytes.getDataLength()});
        return RTC::BufferStatus::OK;
    }
    RTC::BufferStatus read(RTC::ByteData& bytes, std::chrono::nanoseconds) override {
        if (messages.empty()) return RTC::BufferStatus::EMPTY;
        ++counts.copied_out;
        bytes = messages.front().first;
        messages.pop_front();
        return RTC::BufferStatus::OK;
    }
    RTC::BufferStatus readInPlace(RTC::ByteData& bytes, RTC::Unmarshal& use, bool& used) override {
        used = !messages.empty() && messages.front().second >= long_from;
        if (!used) return read(bytes, {});
        ++counts.shown;
        const auto& message = messages.front().first;
        cdrMemoryStream stream(message.getBuffer(), message.getDataLength());
        stream.setByteSwapFlag(true);
        use(stream);
        messages.pop_front();
        return RTC::BufferStatus::OK;
    }

    std::deque<std::pair<RTC::ByteData, std::size_t>> messages;
    Counts counts;
    bool full_now = false;
};

/// An OutPort and an InPort of images with a Place between them.
struct Images {
    Images() : out("image_out", sent), in("image_in", received) {
        RTC::CdrBufferFactory::instance().addFactory("place", coil::Creator<RTC::CdrBufferBase, Place>,
                                                     coil::Destructor<RTC::CdrBufferBase, Place>);
        rtc.addOutPort("image_out", out);
        rtc.addInPort("image_in", in);
    }
    ~Images() {
        rtc.removePort(out);
        rtc.removePort(in);
    }
    void connect(const std::string& more = "") {
        fixture.connect("Counter0.image_out?port=Counter0.image_in&inport.buffer_type=place" + more);
        place = Place::made_last();
    }
    bool send(CORBA::ULong bytes, CORBA::Octet shade) {
        sent.tm.sec = shade;
        sent.data.length(bytes);
        std::fill_n(sent.data.get_buffer(), bytes, shade);
        return out.write();
    }
    bool receive(CORBA::ULong bytes, CORBA::Octet shade) {
        if (!in.read() || received.tm.sec != shade || received.data.length() != bytes) return false;
        const auto* begin = received.data.get_buffer();
        return std::all_of(begin, begin + bytes, [&](CORBA::Octet byte) { return byte == shade; });
    }

    ManagerFixture fixture;
    Counter& rtc = fixture.create<Counter>("Counter");
    RTC::TimedOctetSeq sent{}, received{};
    RTC::OutPort<RTC::TimedOctetSeq> out;
    RTC::InPort<RTC::TimedOctetSeq> in;
    Place* place = nullptr;
};

} // namespace

TEST_CASE("Long messages are made and read in place, the first of a row excepted, and short ones as always") {
    Images images;
    images.connect();
    const CORBA::ULong sizes[] = {100, 50'000, 60'000, 50'000, 100, 200, 50'000, 70'000};
    CORBA::Octet shade = 0;
    for (const auto bytes : sizes) {
        REQUIRE(images.send(bytes, ++shade));
        REQUIRE(images.receive(bytes, shade));
    }
    // Copied: 100, the first 50'000, 100, 200, and the next first.
    CHECK(images.place->counts == Place::Counts{5, 3, 3, 5});
    CHECK_FALSE(images.in.isNew());
}

TEST_CASE("A long message that the place has no room for is reported as full") {
    Images images;
    images.connect();
    REQUIRE(images.send(50'000, 1));
    images.place->full_now = true;
    CHECK_FALSE(images.send(50'000, 2));
    CHECK(images.out.getStatus(0) == RTC::DataPortStatus::BUFFER_FULL);
    CHECK(images.receive(50'000, 1));
}

namespace {

struct Lengths : RTC::ConnectorDataListener {
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData& bytes, const std::string&) override {
        seen.push_back(bytes.getDataLength());
        return NO_CHANGE;
    }
    std::vector<unsigned long> seen;
};

template <class Port>
void check_listened(Images& images, Port& port, RTC::ConnectorDataListenerType type) {
    Lengths lengths;
    images.connect();
    port.addConnectorDataListener(type, &lengths, false);
    for (CORBA::Octet shade = 1; shade <= 3; ++shade) {
        REQUIRE(images.send(50'000, shade));
        REQUIRE(images.receive(50'000, shade));
    }
    CHECK(lengths.seen == std::vector<unsigned long>(3, 50'012));
    port.removeConnectorDataListener(type, &lengths);
}

} // namespace

TEST_CASE("A listener of the OutPort sees the bytes of long messages, too") {
    Images images;
    check_listened(images, images.out, RTC::ON_SEND);
}

TEST_CASE("A listener of the InPort sees the bytes of long messages, too") {
    Images images;
    check_listened(images, images.in, RTC::ON_RECEIVED);
}

TEST_CASE("A listener to what is read sees the bytes of long messages, too") {
    Images images;
    check_listened(images, images.in, RTC::ON_BUFFER_READ);
}

TEST_CASE("A second connection of an OutPort gets long messages as well") {
    Images images;
    RTC::TimedOctetSeq other{};
    RTC::InPort<RTC::TimedOctetSeq> second("second_in", other);
    images.rtc.addInPort("second_in", second);
    images.connect();
    images.fixture.connect("Counter0.image_out?port=Counter0.second_in");
    for (CORBA::Octet shade = 1; shade <= 3; ++shade) {
        REQUIRE(images.send(50'000, shade));
        REQUIRE(images.receive(50'000, shade));
        REQUIRE(second.read());
        CHECK(other.data.length() == 50'000);
        CHECK(other.data[49'999] == shade);
    }
    CHECK(images.place->counts.made > 0);
    images.rtc.removePort(second);
}

TEST_CASE("A long message that is none of the type is an error of the reading port") {
    Images images;
    images.connect();
    RTC::ByteData junk;
    junk.setDataLength(20'000);
    std::fill_n(junk.getBuffer(), 20'000, static_cast<unsigned char>(0xff));
    images.place->messages.push_back({junk, 20'000});
    CHECK_FALSE(images.in.read());
    CHECK(images.in.getStatus(0) == RTC::DataPortStatus::BUFFER_ERROR);
    REQUIRE(images.send(50'000, 1));
    CHECK(images.receive(50'000, 1));
}

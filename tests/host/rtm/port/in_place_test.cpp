// SPDX-License-Identifier: Apache-2.0
// Long messages in a buffer that lets them be made and read where they lie.
#include "host/rt/rehearsal.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/support/membarrier.hpp"
#include "tests/support/skip.hpp"
#include <deque>
#include <rtm/CdrRingBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <thread>

using namespace testing;

namespace {

/// A buffer as a bridge has it in shared memory; counts the operations by their kind.
struct CountingInPlaceBuffer : RTC::CdrRingBuffer, RTC::InPlaceBuffer {
    static inline std::size_t min_in_place_length = 0;
    struct Counts {
        int writes = 0, in_place_writes = 0, reads = 0, in_place_reads = 0;
        bool operator==(const Counts&) const = default;
    };
    static CountingInPlaceBuffer*& last_created() {
        static CountingInPlaceBuffer* buffer = nullptr;
        return buffer;
    }
    void init(const coil::Properties&) override { last_created() = this; }

    std::size_t minInPlaceLength() const override { return min_in_place_length; }
    std::size_t readable() const override { return messages.size(); }
    bool empty() const override { return messages.empty(); }
    RTC::BufferStatus write(const RTC::ByteData& bytes, std::chrono::nanoseconds) override {
        ++counts.writes;
        messages.push_back({bytes, bytes.getDataLength()});
        return RTC::BufferStatus::OK;
    }
    RTC::BufferStatus writeInPlace(const RTC::Marshal& marshal) override {
        if (tandem::rt::rehearsing()) {
            ++rehearsals;
            return RTC::BufferStatus::OK;
        }
        const cdrMemoryStream usual;
        cdrCountingStream counter(usual.TCS_C(), usual.TCS_W());
        if (!marshal(counter) || counter.total() < min_in_place_length)
            return RTC::BufferStatus::NOT_SUPPORTED;
        ++counts.in_place_writes;
        if (is_full) return RTC::BufferStatus::FULL;
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
        ++counts.reads;
        bytes = messages.front().first;
        messages.pop_front();
        return RTC::BufferStatus::OK;
    }
    RTC::BufferStatus readInPlace(RTC::ByteData& bytes, RTC::Unmarshal& reader,
                                  bool& read_in_place) override {
        if (tandem::rt::rehearsing()) {
            ++read_rehearsals;
            read_in_place = true;
            cdrMemoryStream stream(last_read.getBuffer(), last_read.getDataLength());
            stream.setByteSwapFlag(true);
            reader(stream);
            return RTC::BufferStatus::OK;
        }
        read_in_place = !messages.empty() && messages.front().second >= min_in_place_length;
        if (!read_in_place) return read(bytes, {});
        ++counts.in_place_reads;
        const auto& message = messages.front().first;
        cdrMemoryStream stream(message.getBuffer(), message.getDataLength());
        stream.setByteSwapFlag(true);
        reader(stream);
        last_read = message;
        messages.pop_front();
        return RTC::BufferStatus::OK;
    }

    std::deque<std::pair<RTC::ByteData, std::size_t>> messages;
    Counts counts;
    bool is_full = false;
    int rehearsals = 0, read_rehearsals = 0;
    RTC::ByteData last_read;
};

/// An OutPort and an InPort of images with a CountingInPlaceBuffer between them.
struct ImagePorts {
    explicit ImagePorts(std::size_t min_in_place_length = 10'000)
        : out("image_out", sent), in("image_in", received) {
        CountingInPlaceBuffer::min_in_place_length = min_in_place_length;
        RTC::CdrBufferFactory::instance().addFactory(
            "in_place", coil::Creator<RTC::CdrBufferBase, CountingInPlaceBuffer>,
            coil::Destructor<RTC::CdrBufferBase, CountingInPlaceBuffer>);
        rtc.addOutPort("image_out", out);
        rtc.addInPort("image_in", in);
    }
    ~ImagePorts() {
        rtc.removePort(out);
        rtc.removePort(in);
    }
    void connect(const std::string& properties = "") {
        fixture.connect("Counter0.image_out?port=Counter0.image_in&inport.buffer_type=in_place" + properties);
        buffer = CountingInPlaceBuffer::last_created();
    }
    bool send(CORBA::ULong bytes, CORBA::Octet fill) {
        sent.tm.sec = fill;
        sent.data.length(bytes);
        std::fill_n(sent.data.get_buffer(), bytes, fill);
        return out.write();
    }
    bool receive(CORBA::ULong bytes, CORBA::Octet fill) {
        if (!in.read() || received.tm.sec != fill || received.data.length() != bytes) return false;
        const auto* begin = received.data.get_buffer();
        return std::all_of(begin, begin + bytes, [&](CORBA::Octet byte) { return byte == fill; });
    }

    ManagerFixture fixture;
    Counter& rtc = fixture.create<Counter>("Counter");
    RTC::TimedOctetSeq sent{}, received{};
    RTC::OutPort<RTC::TimedOctetSeq> out;
    RTC::InPort<RTC::TimedOctetSeq> in;
    CountingInPlaceBuffer* buffer = nullptr;
};

} // namespace

TEST_CASE("Long messages are encoded and read in place, except the first in a row, and short ones as usual") {
    ImagePorts ports;
    ports.connect();
    const CORBA::ULong sizes[] = {100, 50'000, 60'000, 50'000, 100, 200, 50'000, 70'000};
    CORBA::Octet fill = 0;
    for (const auto bytes : sizes) {
        REQUIRE(ports.send(bytes, ++fill));
        REQUIRE(ports.receive(bytes, fill));
    }
    // Copied: 100, the first 50'000, 100, 200, and the next first.
    CHECK(ports.buffer->counts == CountingInPlaceBuffer::Counts{5, 3, 3, 5});
    CHECK_FALSE(ports.in.isNew());
}

TEST_CASE(
    "A rehearsal of an InPort reads the last message once more and leaves the component's variable alone") {
    ImagePorts ports(0); // as the buffer of a link
    ports.connect();
    for (int i = 0; i < 100; ++i) {
        REQUIRE(ports.send(50'000, 1));
        REQUIRE(ports.receive(50'000, 1));
    }
    std::thread([&] { ports.in.rehearse(); }).join();
    CHECK(ports.buffer->read_rehearsals == 0); // it is another thread that reads
    if (!tandem::test::mutexes_have_owners()) TANDEM_SKIP("membarrier(2) is not permitted");
    const auto counts = ports.buffer->counts;
    ports.received.data.length(0);
    ports.in.rehearse();
    CHECK(ports.buffer->read_rehearsals == 1);
    CHECK(ports.buffer->counts == counts);
    CHECK(ports.received.data.length() == 0);
    for (int i = 0; i < 10'000; ++i) REQUIRE_FALSE(ports.in.isNew());
    CHECK(ports.buffer->read_rehearsals == 3); // every 4096th time
    CHECK(ports.send(50'000, 2));
    CHECK(ports.receive(50'000, 2));
}

TEST_CASE("A rehearsal goes as far as the buffer and sends nothing") {
    ImagePorts ports;
    ports.connect();
    ports.out.rehearse();
    CHECK(ports.buffer->rehearsals == 0); // nobody has written yet
    for (int i = 0; i < 100; ++i) {
        REQUIRE(ports.send(50'000, 1));
        REQUIRE(ports.receive(50'000, 1));
    }
    const auto counts = ports.buffer->counts;
    ports.out.rehearse();
    CHECK(ports.buffer->rehearsals == (tandem::test::mutexes_have_owners() ? 1 : 0));
    CHECK(ports.buffer->counts == counts);
    CHECK_FALSE(ports.in.isNew());
    CHECK(ports.send(50'000, 2));
    CHECK(ports.receive(50'000, 2));
}

TEST_CASE("A long message that the buffer has no room for is reported as full") {
    ImagePorts ports;
    ports.connect();
    REQUIRE(ports.send(50'000, 1));
    ports.buffer->is_full = true;
    CHECK_FALSE(ports.send(50'000, 2));
    CHECK(ports.out.getStatus(0) == RTC::DataPortStatus::BUFFER_FULL);
    CHECK(ports.receive(50'000, 1));
}

namespace {

struct LengthListener : RTC::ConnectorDataListener {
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData& bytes, const std::string&) override {
        seen.push_back(bytes.getDataLength());
        return NO_CHANGE;
    }
    std::vector<unsigned long> seen;
};

template <class Port>
void check_listener_sees_bytes(ImagePorts& ports, Port& port, RTC::ConnectorDataListenerType type) {
    LengthListener listener;
    ports.connect();
    port.addConnectorDataListener(type, &listener, false);
    for (CORBA::Octet fill = 1; fill <= 3; ++fill) {
        REQUIRE(ports.send(50'000, fill));
        REQUIRE(ports.receive(50'000, fill));
    }
    CHECK(listener.seen == std::vector<unsigned long>(3, 50'012));
    port.removeConnectorDataListener(type, &listener);
}

} // namespace

TEST_CASE("A listener of the OutPort sees the bytes of long messages, too") {
    ImagePorts ports;
    check_listener_sees_bytes(ports, ports.out, RTC::ON_SEND);
}

TEST_CASE("A listener of the InPort sees the bytes of long messages, too") {
    ImagePorts ports;
    check_listener_sees_bytes(ports, ports.in, RTC::ON_RECEIVED);
}

TEST_CASE("A listener to what is read sees the bytes of long messages, too") {
    ImagePorts ports;
    check_listener_sees_bytes(ports, ports.in, RTC::ON_BUFFER_READ);
}

TEST_CASE("A second connection of an OutPort gets long messages as well") {
    ImagePorts ports;
    RTC::TimedOctetSeq other{};
    RTC::InPort<RTC::TimedOctetSeq> second("second_in", other);
    ports.rtc.addInPort("second_in", second);
    ports.connect();
    ports.fixture.connect("Counter0.image_out?port=Counter0.second_in");
    for (CORBA::Octet fill = 1; fill <= 3; ++fill) {
        REQUIRE(ports.send(50'000, fill));
        REQUIRE(ports.receive(50'000, fill));
        REQUIRE(second.read());
        CHECK(other.data.length() == 50'000);
        CHECK(other.data[49'999] == fill);
    }
    CHECK(ports.buffer->counts.in_place_writes > 0);
    ports.rtc.removePort(second);
}

TEST_CASE("A long message that does not fit the port's type is an error of the reading port") {
    ImagePorts ports;
    ports.connect();
    RTC::ByteData garbage;
    garbage.setDataLength(20'000);
    std::fill_n(garbage.getBuffer(), 20'000, static_cast<unsigned char>(0xff));
    ports.buffer->messages.push_back({garbage, 20'000});
    CHECK_FALSE(ports.in.read());
    CHECK(ports.in.getStatus(0) == RTC::DataPortStatus::BUFFER_ERROR);
    REQUIRE(ports.send(50'000, 1));
    CHECK(ports.receive(50'000, 1));
}

namespace {

template <class Value>
void check_numbers(CORBA::ULong count) {
    Value value{};
    value.data.length(count);
    const auto check = [&](const auto& numbers) {
        CHECK(numbers.tm == &value.tm);
        CHECK(numbers.elements == value.data.get_buffer());
        CHECK(numbers.count == count);
        CHECK(numbers.element_bytes == sizeof(*value.data.get_buffer()));
    };
    check(RTC::CdrMarshal<Value>(value).numbers());
    check(RTC::CdrUnmarshal<Value>(value).numbers());
}

template <class Value>
bool has_numbers() {
    Value value{};
    return RTC::CdrMarshal<Value>(value).numbers().tm != nullptr ||
           RTC::CdrUnmarshal<Value>(value).numbers().tm != nullptr;
}

} // namespace

TEST_CASE("A buffer finds the time and the numbers of a value, to copy them as one block") {
    for (const CORBA::ULong count : {0U, 1U, 2U, 6U, 31U}) {
        check_numbers<RTC::TimedDoubleSeq>(count);
        check_numbers<RTC::TimedFloatSeq>(count);
        check_numbers<RTC::TimedLongSeq>(count);
        check_numbers<RTC::TimedUShortSeq>(count);
        check_numbers<RTC::TimedOctetSeq>(count);
    }
}

TEST_CASE("Values of other forms, and elements that CDR checks, go through a stream") {
    CHECK_FALSE(has_numbers<RTC::TimedDouble>());
    CHECK_FALSE(has_numbers<RTC::TimedBooleanSeq>());
    CHECK_FALSE(has_numbers<RTC::TimedCharSeq>()); // the ORB checks them by its code set
    CHECK_FALSE(has_numbers<RTC::TimedStringSeq>());
    CHECK_FALSE(has_numbers<RTC::TimedPose2D>());
    CHECK_FALSE(has_numbers<RTC::CameraImage>()); // more than a time and a sequence
}

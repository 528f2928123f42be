// SPDX-License-Identifier: Apache-2.0
// Messages between two processes of a machine through a ring of shared memory; both ends are in the test's process.
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/in_port_connectors.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/transport/ring/message_server.hpp"
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include "host/rtm/runtime/transport/ring/ring_receiver.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include "tests/shm/small_shm.hpp"
#include "tests/support/allocations.hpp"
#include <atomic>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/CdrRingBuffer.h>
#include <rtm/InPort.h>
#include <thread>

using namespace testing;
using RTC::DataPortStatus;

namespace {

using Value = RTC::TimedLongSeq;
constexpr CORBA::ULong short_length = 6, long_length = 10000, too_long = 2200000; // for the ring

RTC::ByteData sequence_of(int number, CORBA::ULong length = short_length) {
    Value value{};
    value.data.length(length);
    for (CORBA::ULong i = 0; i < length; ++i) value.data[i] = number;
    RTC::CORBA_CdrSerializer<Value> stream;
    stream.isLittleEndian(true);
    stream.serialize(value);
    RTC::ByteData bytes = stream;
    bytes.isLittleEndian(true);
    return bytes;
}

struct RingPort : RTC::InPort<Value> {
    explicit RingPort(Value& value) : RTC::InPort<Value>("in", value) {}
    void own(std::unique_ptr<RTC::InPortConnector> connector) { m_connectors.push_back(connector.release()); }
    void disconnect() {
        delete m_connectors.front();
        m_connectors.clear();
    }
};

/// Calls of the connection's put().
struct CountedCalls {
    std::shared_ptr<RTC::PushReceiver> receiver;
    std::atomic<int> count{0};
    std::atomic<bool> answered{true};
};
class CallingReceiver : public RTC::RemoteReceiver {
  public:
    explicit CallingReceiver(std::shared_ptr<CountedCalls> calls) : calls_(std::move(calls)) {}
    std::optional<DataPortStatus> put(const RTC::ByteData& bytes) override {
        ++calls_->count;
        RTC::ByteData copy(bytes);
        const DataPortStatus status = calls_->receiver->receiveCall(copy);
        return calls_->answered ? std::optional(status) : std::nullopt;
    }
    void setTimeout(std::chrono::milliseconds) override {}

  private:
    std::shared_ptr<CountedCalls> calls_;
};

/// An InPort, its connector and the sending end of its connection.
struct RingConnection {
    RingConnection() {
        coil::Properties buffer_properties;
        buffer_properties.setProperty("length", "200000");
        buffer.init(buffer_properties);
        RTC::ConnectorInfo info("c", "id", {}, coil::Properties());
        auto connector = std::make_unique<RTC::InPortPushConnector>(port, info, &buffer, false);
        const RTC::ServantHolder& servant = connector->offerRing(port);
        RTC::ConnectorProfile profile;
        RTC::publish_object(profile, RTC::ring_in_port_key, servant.reference(), servant.ior());
        calls->receiver = connector->receiver();
        port.own(std::move(connector));
        sender =
            RTC::put_ring_before(std::make_unique<CallingReceiver>(calls), profile, std::chrono::seconds(20));
    }
    std::optional<DataPortStatus> put(int number, CORBA::ULong length = short_length) {
        return sender->put(sequence_of(number, length));
    }
    /// The numbers of all messages that the port has.
    std::vector<int> read_all() {
        std::vector<int> numbers;
        while (port.isNew()) {
            REQUIRE(port.read());
            numbers.push_back(value.data[value.data.length() - 1]);
        }
        return numbers;
    }
    ManagerFixture fixture;
    RTC::CdrRingBuffer buffer;
    Value value{};
    RingPort port{value};
    std::shared_ptr<CountedCalls> calls = std::make_shared<CountedCalls>();
    std::unique_ptr<RTC::RemoteReceiver> sender;
};

std::vector<int> numbers_up_to(int last) {
    std::vector<int> numbers;
    for (int number = 1; number <= last; ++number) numbers.push_back(number);
    return numbers;
}

/// Under a mutex, since the thread sanitizer does not know that the segment that orders sender and listener is mapped twice here.
class Numbers {
  public:
    void add(int number) {
        const std::lock_guard lock(mutex_);
        numbers_.push_back(number);
    }
    std::vector<int> all() const {
        const std::lock_guard lock(mutex_);
        return numbers_;
    }

  private:
    mutable std::mutex mutex_;
    std::vector<int> numbers_;
};

struct SequenceListener : RTC::ConnectorDataListenerT<Value> {
    explicit SequenceListener(Numbers& to) : numbers(to) {}
    RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo&, Value& heard) override {
        numbers.add(heard.data[0]);
        return RTC::ConnectorListenerStatus::NO_CHANGE;
    }
    Numbers& numbers;
};

std::vector<std::string> files_of(const std::string& link) {
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
        if (file.path().filename().string().find(link) != std::string::npos) files.push_back(file.path());
    return files;
}

std::span<const std::byte> as_span(const RTC::ByteData& bytes) {
    return std::as_bytes(std::span(bytes.getBuffer(), bytes.getDataLength()));
}

} // namespace

TEST_CASE("Messages between two processes go through shared memory without a call or an allocation") {
    RingConnection connection;
    for (int number : {1, 2, 3}) CHECK(connection.put(number) == DataPortStatus::PORT_OK);
    CHECK(connection.read_all() == numbers_up_to(3));
    const RTC::ByteData bytes = sequence_of(4);
    connection.buffer.length(1); // the memory of each value in the buffer is kept
    connection.sender->put(bytes);
    connection.port.read();
    const auto before = allocations();
    for (int i = 0; i < 100; ++i) {
        connection.sender->put(bytes);
        connection.port.read();
    }
    CHECK(allocations() == before);
    CHECK(connection.value.data[0] == 4);
    CHECK(connection.calls->count == 0);
}

TEST_CASE("Messages that are too long or find the ring full go by calls, in their order") {
    RingConnection connection;
    for (int number = 1; number <= 5000; ++number)
        CHECK(connection.put(number, number % 2000 == 0 ? long_length : short_length) ==
              DataPortStatus::PORT_OK);
    CHECK(connection.calls->count > 2);
    CHECK(connection.calls->count < 100);
    const int before = connection.calls->count;
    connection.put(5001, too_long);
    CHECK(connection.calls->count == before + 1);
    CHECK(connection.read_all() == numbers_up_to(5001));
}

TEST_CASE("Long messages go through shared memory, too, and by calls while the reader has not taken three") {
    RingConnection connection;
    for (int number = 1; number <= 20; ++number) {
        connection.put(number, long_length);
        if (number == 10) CHECK(connection.read_all() == numbers_up_to(10));
    }
    const int calls = connection.calls->count;
    CHECK(calls >= 2);
    CHECK(calls <= 10);
    CHECK(connection.read_all().size() == 10);
    for (int number = 21; number <= 30; ++number) {
        connection.put(number, long_length);
        CHECK(connection.read_all() == std::vector<int>{number});
    }
    CHECK(connection.calls->count == calls);
}

TEST_CASE("Messages that nobody reads go by calls after a while, which shows whether their process answers") {
    RingConnection connection;
    connection.put(1);
    CHECK(connection.calls->count == 0);
    std::this_thread::sleep_for(2 * RTC::MessageRingWriter::max_unread);
    connection.put(2); // the first look at how long nobody has read
    std::this_thread::sleep_for(2 * RTC::MessageRingWriter::max_unread);
    connection.put(3);
    CHECK(connection.calls->count >= 1);
    CHECK(connection.read_all() == numbers_up_to(3));
}

TEST_CASE("No message overtakes one whose call had no answer") {
    RingConnection connection;
    connection.calls->answered = false;
    CHECK_FALSE(connection.put(1, too_long).has_value());
    CHECK_FALSE(connection.put(2).has_value()); // it could have gone through the ring
    CHECK(connection.calls->count == 2);
    connection.calls->answered = true;
    connection.put(3);
    connection.put(4);
    CHECK(connection.calls->count == 3);
    CHECK(connection.read_all() == numbers_up_to(4));
}

TEST_CASE("A listener hears what has come before anybody looked, and each message from then on in its call") {
    RingConnection connection;
    Numbers heard;
    connection.put(1);
    auto* const listener = new SequenceListener(heard);
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, listener);
    CHECK(heard.all() == numbers_up_to(1));
    connection.put(2);
    CHECK(heard.all() == numbers_up_to(2));
    CHECK(connection.calls->count == 1);
    connection.port.removeConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, listener);
    connection.put(3); // the call finds that nobody listens
    connection.put(4);
    CHECK(connection.calls->count == 1);
    CHECK(connection.read_all() == numbers_up_to(4));
}

TEST_CASE(
    "Listeners have heard a message when the sender goes on, and only the first one is a call of the ORB") {
    RingConnection connection;
    Numbers heard;
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED,
                                             new SequenceListener(heard));
    for (int number = 1; number <= 200; ++number) {
        REQUIRE(connection.put(number) == DataPortStatus::PORT_OK);
        REQUIRE(heard.all() == numbers_up_to(number));
    }
    CHECK(connection.calls->count == 1);
    CHECK(connection.put(201, long_length) == DataPortStatus::PORT_OK);
    CHECK(connection.calls->count == 1);
    CHECK(connection.put(202, too_long) == DataPortStatus::PORT_OK);
    CHECK(connection.calls->count == 2);
    CHECK(heard.all() == numbers_up_to(202));
    CHECK(connection.read_all() == numbers_up_to(202));
}

TEST_CASE(
    "A message whose listener takes too long has no answer, and the next ones come after it in their order") {
    struct Slow : SequenceListener {
        using SequenceListener::SequenceListener;
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, Value& heard) override {
            if (heard.data[0] == 2) std::this_thread::sleep_for(std::chrono::milliseconds(200));
            return SequenceListener::operator()(info, heard);
        }
    };
    RingConnection connection;
    Numbers heard;
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new Slow(heard));
    connection.put(1);
    connection.sender->setTimeout(std::chrono::milliseconds(10));
    CHECK_FALSE(connection.put(2).has_value());
    for (int number : {3, 4}) connection.put(number);
    connection.sender->setTimeout(std::chrono::seconds(20));
    CHECK(connection.put(5) == DataPortStatus::PORT_OK);
    CHECK(heard.all() == numbers_up_to(5));
}

TEST_CASE("An exception of a listener is an error of that message alone") {
    struct Throwing : SequenceListener {
        using SequenceListener::SequenceListener;
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, Value& heard) override {
            switch (heard.data[0]) {
            case 2:
                throw std::runtime_error("two");
            case 3:
                throw CORBA::NO_MEMORY();
            case 4:
                throw 4;
            default:
                return SequenceListener::operator()(info, heard);
            }
        }
    };
    RingConnection connection;
    Numbers heard;
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED,
                                             new Throwing(heard));
    CHECK(connection.put(1) == DataPortStatus::PORT_OK);
    for (int number : {2, 3, 4}) CHECK(connection.put(number) == DataPortStatus::PORT_ERROR);
    CHECK(connection.put(5) == DataPortStatus::PORT_OK);
    CHECK(heard.all() == std::vector<int>{1, 5});
}

TEST_CASE("The end of a connection waits for the listener of a message, and refuses later ones") {
    struct Lasting : SequenceListener {
        using SequenceListener::SequenceListener;
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, Value& heard) override {
            has_begun = heard.data[0] == 2;
            if (has_begun) std::this_thread::sleep_for(std::chrono::milliseconds(50));
            return SequenceListener::operator()(info, heard);
        }
        std::atomic<bool> has_begun{false};
    };
    RingConnection connection;
    Numbers heard;
    auto* const lasting = new Lasting(heard);
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, lasting);
    connection.put(1);
    std::thread writer([&] { connection.put(2); });
    CHECK(eventually([&] { return lasting->has_begun.load(); }));
    connection.port.disconnect();
    CHECK(heard.all() == numbers_up_to(2));
    writer.join();
    CHECK(connection.put(3) == DataPortStatus::CONNECTION_LOST);
}

TEST_CASE("A sender that cuts its segment short does not keep the receiver's thread asleep") {
    auto writer = std::make_unique<RTC::MessageRingWriter>();
    const std::string file = files_of(writer->link()).front();
    RTC::MessageRingReader reader(writer->link());
    std::atomic<int> received{0};
    {
        const RTC::MessageServer server(reader, nullptr, [&]() -> std::optional<DataPortStatus> {
            ++received;
            return std::nullopt;
        });
        CHECK(writer->callServer(std::chrono::seconds(20)).status == tandem::shm::CallStatus::ok);
        CHECK(received == 1);
        REQUIRE(::truncate(file.c_str(), 0) == 0);
    }
    CHECK(received == 1);
}

TEST_CASE("A listener may add another one, which hears each message from then on") {
    struct Adding : SequenceListener {
        Adding(Numbers& to, RTC::InPortBase& in) : SequenceListener(to), port(in) {}
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, Value& heard) override {
            if (numbers.all().empty())
                port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_BUFFER_WRITE,
                                              new SequenceListener(by_second));
            return SequenceListener::operator()(info, heard);
        }
        RTC::InPortBase& port;
        Numbers by_second;
    };
    RingConnection connection;
    Numbers heard;
    connection.put(1);
    auto* const first = new Adding(heard, connection.port);
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, first);
    connection.put(2);
    CHECK(heard.all() == numbers_up_to(2));
    CHECK(first->by_second.all() == numbers_up_to(2));
}

TEST_CASE("A message before the end of its connection stays in the port's buffer") {
    RingConnection connection;
    connection.put(1);
    connection.port.disconnect();
    CHECK(connection.buffer.readable() == 1);
}

TEST_CASE("Who looks at a port does not call its listeners, however those were added") {
    RingConnection connection;
    Numbers heard;
    connection.put(1);
    connection.port.getListeners()->addListener(RTC::ConnectorDataListenerType::ON_RECEIVED,
                                                new SequenceListener(heard));
    CHECK_FALSE(connection.port.isNew());
    CHECK(heard.all().empty());
    connection.put(2);
    CHECK(connection.calls->count == 1);
    CHECK(heard.all() == numbers_up_to(2));
    CHECK(connection.read_all() == numbers_up_to(2));
}

TEST_CASE("A receiver that has ended is told from one that does not look") {
    RingConnection connection;
    connection.put(1);
    connection.port.disconnect();
    CHECK(connection.put(2) == DataPortStatus::CONNECTION_LOST);
    CHECK(connection.calls->count == 1);
}

TEST_CASE("A port with several connectors sends into the ring in the writer's thread") {
    RingConnection connection;
    RTC::RemotePush::Limits limits;
    limits.shared_answer_timeout = std::chrono::seconds(20); // for the answer to the call
    RTC::RemotePush push(std::move(connection.sender), limits);
    for (int number : {1, 2, 3}) CHECK(push.write(sequence_of(number), false) == DataPortStatus::PORT_OK);
    CHECK(connection.calls->count == 0);
    CHECK(push.write(sequence_of(4, too_long), false) == DataPortStatus::PORT_OK);
    CHECK(push.write(sequence_of(5), false) == DataPortStatus::PORT_OK);
    CHECK(connection.calls->count == 1);
    CHECK(connection.read_all() == numbers_up_to(5));
}

TEST_CASE("Messages keep their order and are all there while others read, listen and call") {
    constexpr int last = 30000;
    RingConnection connection;
    std::thread writer([&] {
        for (int number = 1; number <= last; ++number)
            connection.put(number, number % 97 == 0 ? long_length : short_length);
    });
    std::vector<int> numbers;
    Numbers heard;
    while (numbers.size() < last) {
        if (numbers.size() % 512 == 200) {
            auto* const listener = new SequenceListener(heard);
            connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, listener);
            connection.port.removeConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED,
                                                        listener);
        }
        if (!connection.port.isNew()) continue;
        REQUIRE(connection.port.read());
        numbers.push_back(connection.value.data[0]);
    }
    writer.join();
    CHECK(numbers == numbers_up_to(last));
    const auto all_heard = heard.all();
    CHECK(std::is_sorted(all_heard.begin(), all_heard.end()));
}

TEST_CASE("The segment of a connection has no name once both ends are there") {
    RTC::MessageRingWriter writer;
    CHECK(files_of(writer.link()).size() == 1);
    RTC::MessageRingReader reader(writer.link());
    writer.removeName();
    CHECK(files_of(writer.link()).empty());
    CHECK_FALSE(writer.write(as_span(sequence_of(1)))); // not accepted yet
    reader.acceptMessages(true);
    CHECK(writer.write(as_span(sequence_of(1))));
    CHECK(reader.take()->size() == sequence_of(1).getDataLength());
    CHECK_FALSE(reader.take().has_value());
}

TEST_CASE("Where /dev/shm has no room messages go by calls, and none is lost") {
    if (!tandem::shm::test::enter_small_shm()) {
        WARN("skipped: this user may not mount a /dev/shm of his own");
        return;
    }
    RingConnection connection;
    connection.put(1);
    connection.put(2, 500000); // 2 MB, of 1 MiB
    connection.put(3);
    CHECK(connection.calls->count == 1);
    std::ofstream("/dev/shm/full") << std::string(std::size_t{1} << 20, 'x') << std::flush;
    RTC::ConnectorProfile profile;
    auto* const connector = dynamic_cast<RTC::InPortPushConnector*>(connection.port.connectors().front());
    RTC::publish_object(profile, RTC::ring_in_port_key, connector->offerRing(connection.port).reference(),
                        "");
    const auto without_ring = RTC::put_ring_before(std::make_unique<CallingReceiver>(connection.calls),
                                                   profile, std::chrono::seconds(20));
    without_ring->put(sequence_of(4));
    CHECK(connection.calls->count == 2);
    CHECK(connection.read_all() == numbers_up_to(4));
}

TEST_CASE("A ring that is not there is refused in one line, and leaves no file") {
    CHECK_THROWS_AS(RTC::MessageRingReader("rtm-of-nobody"), tandem::shm::Error);
    CHECK(files_of("rtm-of-nobody").empty());
    CHECK_THROWS_AS(RTC::MessageRingReader("../no/link"), tandem::shm::Error);
}

TEST_CASE("A ring that the other process has damaged gives nothing more") {
    RTC::MessageRingWriter writer;
    RTC::MessageRingReader reader(writer.link());
    reader.acceptMessages(true);
    REQUIRE(writer.write(as_span(sequence_of(1))));
    const int file = ::open(files_of(writer.link()).front().c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(file >= 0);
    const std::vector<unsigned char> damage(std::size_t{48} * 1024, 0xff);
    constexpr off_t behind_sizes = tandem::shm::layout::arenas_begin + 1024;
    CHECK(::pwrite(file, damage.data(), damage.size(), behind_sizes) == static_cast<ssize_t>(damage.size()));
    ::close(file);
    for (int i = 0; i < 100 && !reader.isCorrupt(); ++i) reader.take();
    CHECK(reader.isCorrupt());
    CHECK_FALSE(reader.take().has_value());
}

TEST_CASE("Only ports for which it makes no difference take messages from a ring") {
    const auto can = [](const char* key, const char* value) {
        coil::Properties properties;
        properties.setProperty(key, value);
        return RTC::can_take_from_ring(properties);
    };
    CHECK(can("interface_type", "corba_cdr"));
    CHECK(can("buffer.write.full_policy", "overwrite"));
    CHECK(can("buffer.read.empty_policy", "do_nothing"));
    CHECK(can("interface_type", "data_service"));
    CHECK(can("interface_type", "shared_memory"));
    CHECK_FALSE(can("buffer_type", "of_a_library"));
    CHECK_FALSE(can("buffer.write.full_policy", "do_nothing"));
    CHECK_FALSE(can("buffer.write.full_policy", "block"));
    CHECK_FALSE(can("buffer.read.empty_policy", "block"));
    CHECK_FALSE(can("timestamp_policy", "on_received"));
}

TEST_CASE("An rtm_host sends a port of another one its messages through a ring") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:200"});
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    RTC::RTObject_var here = accumulator.getObjRef(),
                      there = other.component(fixture.manager().theORB(), "Counter0");
    REQUIRE(CORBA_RTCUtil::connect_by_name("in", coil::Properties(), there.in(), "out", here.in(), "in") ==
            RTC::RTC_OK);
    RTC::ConnectorProfileList_var profiles = accumulator.in_.get_connector_profiles();
    REQUIRE(profiles->length() == 1);
    CHECK_FALSE(
        NVUtil::toString(profiles[0].properties, (std::string(RTC::ring_in_port_key) + "_ior").c_str())
            .empty());
    CORBA_RTCUtil::activate(there.in());
    RTC::InPortConnector* const connector = accumulator.in_.connectors().front();
    // What the ring has is not in the port's buffer before it is looked at: calls would have brought it there.
    CHECK(eventually([&] { return connector->readableCount() > 0; }));
    while (accumulator.in_.isNew()) accumulator.in_.read();
    CHECK(eventually([&] {
        const bool was_empty = connector->getBuffer()->readable() == 0;
        return was_empty && accumulator.in_.isNew();
    }));
}

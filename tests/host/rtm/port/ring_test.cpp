// SPDX-License-Identifier: Apache-2.0
// Messages between two processes of a machine through a ring of shared memory.
#include "host/rtm/runtime/transport/remote_push.hpp"
#include "tests/host/rtm/port/ring_connection.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include "tests/shm/small_shm.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/skip.hpp"
#include <fcntl.h>
#include <fstream>
#include <rtm/CORBA_RTCUtil.h>
#include <thread>

using namespace testing;

TEST_CASE("Messages between two processes go through shared memory without a call or an allocation") {
    RingConnection connection;
    for (int number : {1, 2, 3}) CHECK(connection.put(number) == DataPortStatus::PORT_OK);
    CHECK(connection.read_all() == numbers_up_to(3));
    const RTC::ByteData bytes = sequence_of(4);
    connection.buffer.length(1); // with four values, the memory of which is kept
    for (int i = 0; i < 4; ++i) {
        connection.sender->put(bytes);
        connection.port.read();
    }
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

TEST_CASE("Messages that are not read go by calls after a while, which show whether the receiving process "
          "answers") {
    RingConnection connection;
    connection.put(1);
    CHECK(connection.calls->count == 0);
    std::this_thread::sleep_for(2 * RTC::MessageRingWriter::max_unread);
    connection.put(2); // the first check of how long the port has not been read
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

TEST_CASE("A message before the end of its connection stays in the port's buffer") {
    RingConnection connection;
    connection.put(1);
    connection.port.disconnect();
    CHECK(connection.buffer.readable() == 1);
}

TEST_CASE("A receiver that has ended is distinguished from one that does not read") {
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
    RTC::RemotePush push(std::move(connection.sender), limits, "ring");
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
    writer.remove_name();
    CHECK(files_of(writer.link()).empty());
    CHECK_FALSE(writer.write(as_span(sequence_of(1)))); // not accepted yet
    reader.accept_messages(true);
    CHECK(writer.write(as_span(sequence_of(1))));
    CHECK(reader.read()->size() == sequence_of(1).getDataLength());
    CHECK_FALSE(reader.read().has_value());
}

TEST_CASE("If /dev/shm is full, messages go by calls, and none is lost") {
    if (!tandem::shm::test::enter_small_shm()) TANDEM_SKIP("this user may not mount a /dev/shm of his own");
    RingConnection connection;
    connection.put(1);
    connection.put(2, 500000); // 2 MB, of 1 MiB
    connection.put(3);
    CHECK(connection.calls->count == 1);
    std::ofstream("/dev/shm/full") << std::string(std::size_t{1} << 20, 'x') << std::flush;
    RTC::ConnectorProfile profile;
    auto* const connector = dynamic_cast<RTC::InPortPushConnector*>(connection.port.connectors().front());
    RTC::publish_object(profile, RTC::ring_in_port_key, connector->offer_ring(connection.port).reference(),
                        "");
    const auto without_ring = RTC::add_ring_if_possible(std::make_unique<CallingReceiver>(connection.calls),
                                                        profile, std::chrono::seconds(20));
    without_ring->put(sequence_of(4));
    CHECK(connection.calls->count == 2);
    CHECK(connection.read_all() == numbers_up_to(4));
}

TEST_CASE("A ring that does not exist is refused in one line, and leaves no file") {
    CHECK_THROWS_AS(RTC::MessageRingReader("rtm-messages-of-nobody"), tandem::shm::Error);
    CHECK(files_of("rtm-messages-of-nobody").empty());
}

TEST_CASE("A ring under a name that a sender does not give is refused before its segment is looked for") {
    for (const char* name : {"plant", "rtm-of-nobody", "../no/link", ""})
        CHECK_THROWS_WITH(RTC::MessageRingReader(name),
                          Catch::Contains("': not a name of a segment for messages"));
}

TEST_CASE("A ring that the other process has damaged delivers no more messages") {
    RTC::MessageRingWriter writer;
    RTC::MessageRingReader reader(writer.link());
    reader.accept_messages(true);
    REQUIRE(writer.write(as_span(sequence_of(1))));
    const int file = ::open(files_of(writer.link()).front().c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(file >= 0);
    const std::vector<unsigned char> damage(std::size_t{48} * 1024, 0xff);
    constexpr off_t behind_sizes = tandem::shm::layout::arenas_begin + 1024;
    CHECK(::pwrite(file, damage.data(), damage.size(), behind_sizes) == static_cast<ssize_t>(damage.size()));
    ::close(file);
    for (int i = 0; i < 100 && !reader.is_corrupt(); ++i) reader.read();
    CHECK(reader.is_corrupt());
    CHECK_FALSE(reader.read().has_value());
}

TEST_CASE("Only ports for which it makes no difference take messages from a ring") {
    const auto can = [](const char* key, const char* value) {
        coil::Properties properties;
        properties.setProperty(key, value);
        return RTC::can_receive_from_ring(properties);
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
    // Messages in the ring enter the port's buffer only when the port is read; calls would have put them there at once.
    CHECK(eventually([&] { return connector->readableCount() > 0; }));
    while (accumulator.in_.isNew()) accumulator.in_.read();
    CHECK(eventually([&] {
        const bool was_empty = connector->getBuffer()->readable() == 0;
        return was_empty && accumulator.in_.isNew();
    }));
}

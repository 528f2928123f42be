// SPDX-License-Identifier: Apache-2.0
// Messages through shared memory to a port with listeners.
#include "host/rtm/runtime/transport/ring/message_server.hpp"
#include "tests/host/rtm/port/ring_connection.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <thread>
#include <unistd.h>

using namespace testing;

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

TEST_CASE("Listeners have received a message when the sender continues, and only the first message is a call "
          "of the ORB") {
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
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, RingValue& heard) override {
            if (heard.data[0] == 2) std::this_thread::sleep_for(std::chrono::milliseconds(200));
            return SequenceListener::operator()(info, heard);
        }
    };
    RingConnection connection;
    Numbers heard;
    connection.port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new Slow(heard));
    connection.put(1);
    connection.sender->set_timeout(std::chrono::milliseconds(10));
    CHECK_FALSE(connection.put(2).has_value());
    for (int number : {3, 4}) connection.put(number);
    connection.sender->set_timeout(std::chrono::seconds(20));
    CHECK(connection.put(5) == DataPortStatus::PORT_OK);
    CHECK(heard.all() == numbers_up_to(5));
}

TEST_CASE("An exception of a listener is an error of that message alone") {
    struct Throwing : SequenceListener {
        using SequenceListener::SequenceListener;
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, RingValue& heard) override {
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
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, RingValue& heard) override {
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
        CHECK(writer->call_server(std::chrono::seconds(20)).status == tandem::shm::CallStatus::ok);
        CHECK(received == 1);
        REQUIRE(::truncate(file.c_str(), 0) == 0);
    }
    CHECK(received == 1);
}

TEST_CASE("A listener may add another one, which hears each message from then on") {
    struct Adding : SequenceListener {
        Adding(Numbers& to, RTC::InPortBase& in) : SequenceListener(to), port(in) {}
        RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo& info, RingValue& heard) override {
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

TEST_CASE("Reading a port does not call its listeners, however they were added") {
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

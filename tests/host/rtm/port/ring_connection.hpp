// SPDX-License-Identifier: Apache-2.0
// A connection through shared memory, both of whose ends are in the test's process.
#pragma once
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/in_port_connectors.hpp"
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include "host/rtm/runtime/transport/ring/ring_sender.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <atomic>
#include <filesystem>
#include <mutex>
#include <rtm/InPort.h>

namespace testing {

using RTC::DataPortStatus;

using RingValue = RTC::TimedLongSeq;
constexpr CORBA::ULong short_length = 6, long_length = 10000, too_long = 2200000; // for the ring

inline RTC::ByteData sequence_of(int number, CORBA::ULong length = short_length) {
    RingValue value{};
    value.data.length(length);
    for (CORBA::ULong i = 0; i < length; ++i) value.data[i] = number;
    RTC::CORBA_CdrSerializer<RingValue> stream;
    stream.isLittleEndian(true);
    stream.serialize(value);
    RTC::ByteData bytes = stream;
    bytes.isLittleEndian(true);
    return bytes;
}

struct RingPort : RTC::InPort<RingValue> {
    explicit RingPort(RingValue& value) : RTC::InPort<RingValue>("in", value) {}
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
        const DataPortStatus status = calls_->receiver->receive_by_call(copy);
        return calls_->answered ? std::optional(status) : std::nullopt;
    }
    void set_timeout(std::chrono::milliseconds) override {}

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
        const RTC::ServantHolder& servant = connector->offer_ring(port);
        RTC::ConnectorProfile profile;
        RTC::publish_object(profile, RTC::ring_in_port_key, servant.reference(), servant.ior());
        calls->receiver = connector->receiver();
        port.own(std::move(connector));
        sender = RTC::add_ring_if_possible(std::make_unique<CallingReceiver>(calls), profile,
                                           std::chrono::seconds(20));
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
    RTC::PortBuffer buffer; // as an InPort has it
    RingValue value{};
    RingPort port{value};
    std::shared_ptr<CountedCalls> calls = std::make_shared<CountedCalls>();
    std::unique_ptr<RTC::RemoteReceiver> sender;
};

inline std::vector<int> numbers_up_to(int last) {
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

struct SequenceListener : RTC::ConnectorDataListenerT<RingValue> {
    explicit SequenceListener(Numbers& to) : numbers(to) {}
    RTC::ConnectorListenerStatus::Enum operator()(RTC::ConnectorInfo&, RingValue& heard) override {
        numbers.add(heard.data[0]);
        return RTC::ConnectorListenerStatus::NO_CHANGE;
    }
    Numbers& numbers;
};

inline std::vector<std::string> files_of(const std::string& link) {
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
        if (file.path().filename().string().find(link) != std::string::npos) files.push_back(file.path());
    return files;
}

inline std::span<const std::byte> as_span(const RTC::ByteData& bytes) {
    return std::as_bytes(std::span(bytes.getBuffer(), bytes.getDataLength()));
}

} // namespace testing

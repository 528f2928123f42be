// SPDX-License-Identifier: Apache-2.0
// Several calls at a time to a receiver on another machine, of which only the newest value counts.
#include "host/rtm/runtime/transport/newest/newest_push.hpp"
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <condition_variable>
#include <map>
#include <mutex>
#include <rtm/CdrRingBuffer.h>
#include <rtm/InPort.h>
#include <thread>

using namespace testing;

namespace {

/// Calls that end when the test says so.
struct HeldCalls {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::uint64_t> begun;
    std::map<std::uint64_t, std::optional<RTC::DataPortStatus>> answers;
    std::size_t ended = 0;
    bool all_end = false;

    void wait_for_calls(std::size_t count) {
        std::unique_lock lock(mutex);
        REQUIRE(changed.wait_for(lock, std::chrono::seconds(60), [&] { return begun.size() >= count; }));
    }
    void answer(std::uint64_t number, std::optional<RTC::DataPortStatus> status) {
        std::unique_lock lock(mutex);
        const std::size_t before = ended;
        answers[number] = status;
        changed.notify_all();
        REQUIRE(changed.wait_for(lock, std::chrono::seconds(60), [&] { return ended > before; }));
    }
};

class HeldReceiver : public RTC::NumberedReceiver {
  public:
    explicit HeldReceiver(std::shared_ptr<HeldCalls> calls) : calls_(std::move(calls)) {}
    std::optional<RTC::DataPortStatus> put(std::uint64_t number, const RTC::ByteData&) override {
        std::unique_lock lock(calls_->mutex);
        calls_->begun.push_back(number);
        calls_->changed.notify_all();
        calls_->changed.wait(lock, [&] { return calls_->all_end || calls_->answers.count(number) > 0; });
        ++calls_->ended;
        calls_->changed.notify_all();
        return calls_->answers.count(number) > 0 ? calls_->answers[number] : std::nullopt;
    }

  private:
    std::shared_ptr<HeldCalls> calls_;
};

struct HeldPush {
    std::shared_ptr<HeldCalls> calls = std::make_shared<HeldCalls>();
    RTC::NewestPush push{std::make_unique<HeldReceiver>(calls)};
    RTC::DataPortStatus write() { return push.write(RTC::ByteData()); }
    /// Writes this number of values, each by a separate call.
    void begin_calls(std::size_t count) {
        for (std::size_t call = 1; call <= count; ++call) {
            CHECK(write() == RTC::DataPortStatus::PORT_OK);
            calls->wait_for_calls(call);
        }
    }
    /// Returns the result of write() after the thread with an answer has passed the answer on.
    RTC::DataPortStatus write_until(RTC::DataPortStatus expected) {
        RTC::DataPortStatus status = write();
        for (int i = 0; i < 6000 && status != expected; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            status = write();
        }
        return status;
    }
    ~HeldPush() {
        const std::lock_guard lock(calls->mutex);
        calls->all_end = true;
        calls->changed.notify_all();
    }
};

RTC::ByteData message(int number) {
    RTC::TimedLong value{};
    value.data = number;
    RTC::CORBA_CdrSerializer<RTC::TimedLong> stream;
    stream.isLittleEndian(true);
    stream.serialize(value);
    RTC::ByteData bytes = stream;
    bytes.isLittleEndian(true);
    return bytes;
}

} // namespace

TEST_CASE("A newest value does not wait for the answer to an earlier one") {
    HeldPush held;
    held.begin_calls(3);
    CHECK(held.calls->begun == std::vector<std::uint64_t>{1, 2, 3});
    CHECK(held.calls->ended == 0);
}

TEST_CASE("While no call is free only the newest value waits for one") {
    HeldPush held;
    held.begin_calls(RTC::NewestPush::max_calls);
    held.write();
    held.write();
    held.write();
    held.calls->answer(5, RTC::DataPortStatus::PORT_OK);
    held.calls->wait_for_calls(RTC::NewestPush::max_calls + 1);
    CHECK(held.calls->begun.back() == RTC::NewestPush::max_calls + 3);
}

TEST_CASE("Of several calls the answer to the newest value counts") {
    HeldPush held;
    held.begin_calls(2);
    held.calls->answer(2, RTC::DataPortStatus::SEND_FULL);
    CHECK(held.write_until(RTC::DataPortStatus::SEND_FULL) == RTC::DataPortStatus::SEND_FULL);
    held.calls->answer(1, std::nullopt);
    CHECK(held.write() == RTC::DataPortStatus::SEND_FULL);
}

TEST_CASE("A receiver that one of several calls finds gone stays gone") {
    HeldPush held;
    held.begin_calls(2);
    held.calls->answer(1, RTC::DataPortStatus::CONNECTION_LOST);
    CHECK(held.write_until(RTC::DataPortStatus::CONNECTION_LOST) == RTC::DataPortStatus::CONNECTION_LOST);
    held.calls->answer(2, RTC::DataPortStatus::PORT_OK);
    CHECK(held.write() == RTC::DataPortStatus::CONNECTION_LOST);
}

TEST_CASE("Numbered messages that were overtaken or repeated are skipped") {
    ManagerFixture fixture;
    RTC::TimedLong value{};
    RTC::InPort<RTC::TimedLong> port("in", value);
    RTC::ConnectorInfo info("c", "id", {}, coil::Properties());
    RTC::CdrRingBuffer buffer;
    RTC::PushReceiver receiver(port, info, buffer);
    for (int number : {2, 1, 2, 5, 3, 6}) {
        RTC::ByteData bytes = message(number);
        CHECK(receiver.receive_numbered(static_cast<std::uint64_t>(number), bytes) ==
              RTC::DataPortStatus::PORT_OK);
    }
    std::vector<int> received;
    for (RTC::ByteData bytes; buffer.readable() > 0 && buffer.read(bytes) == RTC::BufferStatus::OK;) {
        RTC::CORBA_CdrSerializer<RTC::TimedLong> stream;
        stream.isLittleEndian(true);
        stream.writeData(bytes.getBuffer(), bytes.getDataLength());
        stream.deserialize(value);
        received.push_back(value.data);
    }
    CHECK(received == std::vector<int>{2, 5, 6});
    receiver.close();
    RTC::ByteData bytes = message(7);
    CHECK(receiver.receive_numbered(7, bytes) == RTC::DataPortStatus::CONNECTION_LOST);
}

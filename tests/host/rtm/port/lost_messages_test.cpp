// SPDX-License-Identifier: Apache-2.0
// Messages that write() has accepted, and that their connection loses later.
#include "host/rtm/runtime/transport/publisher.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"
#include "tests/host/rtm/log_lines.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <atomic>
#include <thread>

using namespace testing;
using RTC::DataPortStatus;

namespace {

/// A receiver in another process whose listener does not return: a call has no answer.
struct HangingReceiver : RTC::RemoteReceiver {
    explicit HangingReceiver(const std::atomic<bool>& given_up) : given_up_(given_up) {}
    std::optional<DataPortStatus> put(const RTC::ByteData&) override {
        while (!given_up_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return std::nullopt;
    }
    void set_timeout(std::chrono::milliseconds) override {}
    const std::atomic<bool>& given_up_;
};

template <class Condition>
bool eventually(Condition condition) {
    for (int i = 0; i < 10'000 && !condition(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return condition();
}

constexpr const char* lost_three =
    "connections: connection slow: 3 messages that write() had accepted are lost";

} // namespace

TEST_CASE(
    "Messages that wait for a receiver that does not answer are counted in the log when they are lost") {
    ManagerFixture fixture(false, {"logger.log_level:WARN"});
    LogLines lines("write() had accepted");
    fixture.manager().getLogStreamBuf().addStream(&lines);
    std::atomic<bool> given_up{false};
    RTC::RemotePush::Limits limits;
    limits.shared_answer_timeout = std::chrono::milliseconds(1);
    RTC::RemotePush push(std::make_unique<HangingReceiver>(given_up), limits, "slow");
    const RTC::ByteData message;
    for (int i = 0; i < 3; ++i) CHECK(push.write(message, false) == DataPortStatus::PORT_OK);
    given_up = true;
    CHECK(eventually([&] { return lines.get().rfind(lost_three, 0) == 0; }));
    CHECK(push.write(message, false) == DataPortStatus::CONNECTION_LOST);
    CHECK(push.undelivered() == 3);
    fixture.manager().getLogStreamBuf().removeStream(&lines);
}

TEST_CASE("Messages that wait for a publisher are counted in the log when they are lost") {
    ManagerFixture fixture(false, {"logger.log_level:WARN"});
    LogLines lines("write() had accepted");
    fixture.manager().getLogStreamBuf().addStream(&lines);
    coil::Properties properties;
    properties.setProperty("subscription_type", "new");
    properties.setProperty("push_policy", "all");
    std::atomic<bool> all_written{false};
    auto publisher = RTC::Publisher::create(properties, "slow", [&](RTC::ByteData&) {
        while (!all_written) std::this_thread::yield();
        return DataPortStatus::CONNECTION_LOST;
    });
    const RTC::ByteData message;
    bool overwritten = false;
    for (int i = 0; i < 3; ++i) CHECK(publisher->write(message, overwritten) == DataPortStatus::PORT_OK);
    all_written = true;
    CHECK(eventually([&] { return lines.get().rfind(lost_three, 0) == 0; }));
    publisher.reset();
    fixture.manager().getLogStreamBuf().removeStream(&lines);
}

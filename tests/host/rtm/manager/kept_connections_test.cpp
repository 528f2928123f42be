// SPDX-License-Identifier: Apache-2.0
// Connections of manager.components.preconnect that a user disconnects.
#include "host/process/published/refused_connections.hpp"
#include "tests/host/rtm/log_lines.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <unistd.h>

using namespace testing;

namespace {

/// Calls a function at a step of a connection.
class AtStep : public RTC::PortConnectRetListener {
  public:
    explicit AtStep(std::function<void()> call) : call_(std::move(call)) {}
    void operator()(const char*, RTC::ConnectorProfile&, RTC::ReturnCode_t) override { call_(); }

  private:
    const std::function<void()> call_;
};

/// The connections that this process shows other processes as not made: both ports of each.
std::vector<std::string> refused_connections() {
    using tandem::process::RefusedConnections;
    std::vector<std::string> ports;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code closed;
        const auto target = std::filesystem::read_symlink(entry.path(), closed).string();
        if (target.find(RefusedConnections::file_name) == std::string::npos) continue;
        const int file = open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
        RefusedConnections copy{};
        const auto bytes = pread(file, &copy, sizeof copy, 0);
        close(file);
        for (const auto& place : copy.place)
            if (bytes == static_cast<ssize_t>(sizeof copy) && place.taken != 0)
                ports.push_back(std::string(place.from) + " " + place.to);
    }
    return ports;
}

void wait_for_some_checks() { std::this_thread::sleep_for(std::chrono::milliseconds(500)); }

} // namespace

TEST_CASE("A kept connection that is disconnected on purpose stays disconnected") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {short_check_interval});
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Accumulator0.in?port=rtcloc://127.0.0.1:" + other.port + "/Counter0.out");
    CHECK(connection_count(accumulator.in_) == 1);
    wait_for_some_checks();
    CHECK(accumulator.in_.disconnect_all() == RTC::RTC_OK);
    wait_for_some_checks();
    CHECK(connection_count(accumulator.in_) == 0);
}

TEST_CASE("A kept connection that is disconnected before the first check of its peer stays disconnected") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {"manager.peer_check_interval:0.3"});
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Accumulator0.in?port=rtcloc://127.0.0.1:" + other.port + "/Counter0.out");
    CHECK(accumulator.in_.disconnect_all() == RTC::RTC_OK);
    std::this_thread::sleep_for(std::chrono::seconds(1));
    CHECK(connection_count(accumulator.in_) == 0);
}

TEST_CASE("A write that falls into a disconnection neither restores the connection nor logs a lost peer") {
    LogLines lines("is gone");
    RemoteHost other("Reporter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {short_check_interval, "logger.log_level:WARN"});
    fixture.manager().getLogStreamBuf().addStream(&lines);
    auto& counter = fixture.create<Counter>("Counter");
    fixture.connect("Counter0.out?port=rtcloc://127.0.0.1:" + other.port + "/Reporter0.in");
    REQUIRE(connection_count(counter.out_) == 1);
    bool has_written = false;
    AtStep receiver_has_left([&] { // the sender still has its connector
        for (int i = 0; i < 20; ++i) counter.out_.write();
        has_written = true;
    });
    const auto step = RTC::PortConnectRetListenerType::ON_DISCONNECT_NEXT;
    counter.out_.addPortConnectRetListener(step, &receiver_has_left, false);
    CHECK(counter.out_.disconnect_all() == RTC::RTC_OK);
    CHECK(has_written);
    wait_for_some_checks();
    CHECK(connection_count(counter.out_) == 0);
    CHECK(lines.get().empty());
    counter.out_.removePortConnectRetListener(step, &receiver_has_left);
    fixture.manager().getLogStreamBuf().removeStream(&lines);
}

TEST_CASE("A kept connection whose peer is gone is shown to observers until it is made again") {
    auto other = std::make_unique<RemoteHost>("Counter");
    REQUIRE(other->host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {short_check_interval});
    fixture.create<Accumulator>("Accumulator");
    const std::string port = other->port, remote = "rtcloc://127.0.0.1:" + port + "/Counter0.out";
    fixture.connect("Accumulator0.in?port=" + remote);
    wait_for_some_checks();
    CHECK(refused_connections().empty());
    other.reset();
    CHECK(eventually([] { return refused_connections().size() == 1; }));
    CHECK_THAT(refused_connections().at(0), Catch::Contains("Accumulator0.in") && Catch::Contains(remote));
    const RemoteHost again("Counter", port);
    CHECK(eventually([] { return refused_connections().empty(); }));
}

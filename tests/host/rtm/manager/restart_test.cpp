// SPDX-License-Identifier: Apache-2.0
// A host that is killed and started again beside one that keeps running: connections of preconnect are made again,
// whichever of the two has the entry, and nothing is left of the earlier ones.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <algorithm>
#include <filesystem>
#include <rtm/CORBA_RTCUtil.h>

using namespace testing;

namespace {

constexpr int lives = 4;
const std::vector<std::string> ways = {"", "&dataflow_type=pull", "&interface_type=data_service"};

std::string at(const std::string& port) { return "rtcloc://127.0.0.1:" + port + "/"; }

std::size_t open_files() {
    namespace fs = std::filesystem;
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

/// Starts and kills the remote host several times. `works(host)` must be true in each life, `left()` must become 0
/// after each: the number of connections that remain.
template <class Works, class Left>
void restart(const std::string& component, const std::string& port, const std::vector<std::string>& settings,
             Works works, Left left) {
    std::size_t files = 0;
    for (int life = 0; life < lives; ++life) {
        INFO("life " << life);
        RemoteHost other(component, port, settings);
        REQUIRE(other.host.wait_for_output("ready\n"));
        CHECK(works(other));
        other.host.send_signal(SIGKILL);
        other.host.wait_for_exit();
        CHECK(eventually([&] { return left() == 0; }));
        if (life == 1) files = open_files();
        // An idle connection of the ORB may be open or not, and one whose peer has died is closed soon after.
        if (life > 1) CHECK(eventually([&] { return open_files() <= files + 2; }));
    }
}

} // namespace

TEST_CASE("A sender that is killed and restarted is read again by push and by pull") {
    const std::string port = unused_port();
    ManagerFixture fixture(false, {short_check_interval, "exec_cxt.periodic.rate:200"});
    std::vector<Accumulator*> accumulators;
    for (const auto& way : ways) {
        accumulators.push_back(&fixture.create<Accumulator>("Accumulator"));
        fixture.connect(std::string(accumulators.back()->getInstanceName()) + ".in?port=" + at(port) +
                        "Counter0.out" + way);
    }
    restart(
        "Counter", port, {"manager.components.preactivation:Counter0"},
        [&](RemoteHost&) {
            return std::all_of(accumulators.begin(), accumulators.end(), [](Accumulator* accumulator) {
                return eventually(
                    [&] { return connection_count(accumulator->in_) == 1 && accumulator->in_.read(); });
            });
        },
        [&] {
            return connection_count(accumulators[0]->in_) + connection_count(accumulators[1]->in_) +
                   connection_count(accumulators[2]->in_);
        });
}

TEST_CASE("A receiver that is killed and restarted gets data again whichever side connects them") {
    const std::string here = unused_port(), port = unused_port();
    ManagerFixture fixture(
        false, {short_check_interval, "exec_cxt.periodic.rate:200", "corba.endpoints:127.0.0.1:" + here});
    auto& counter = fixture.create<Counter>("Counter");
    CORBA_RTCUtil::activate(RTC::RTObject_var(counter.getObjRef()).in());
    const auto left = [&] { return connection_count(counter.out_); };
    const std::string activation = "manager.components.preactivation:Reporter0";
    for (const auto& way : ways) {
        INFO("its own host connects it " << way);
        const bool reports =
            way.find("pull") == std::string::npos; // the Reporter only reads what isNew() announces
        restart(
            "Reporter", unused_port(),
            {activation,
             "manager.components.preconnect:Reporter0.in?port=" + at(here) + "Counter0.out" + way},
            [&](RemoteHost& other) {
                return (!reports || other.host.wait_for_output("received ")) && left() == 1;
            },
            left);
    }
    for (const auto& way : ways)
        fixture.connect("Counter0.out?port=" + at(port) + "Reporter0.in" + way + "&allow_dup_connection=YES");
    restart(
        "Reporter", port, {activation},
        [&](RemoteHost& other) {
            return other.host.wait_for_output("received ") &&
                   eventually([&] { return left() == ways.size(); });
        },
        left);
}

TEST_CASE(
    "A host that has forked a helper is gone for its peers when it is killed, and gets its port again") {
    const std::string port = unused_port();
    ManagerFixture fixture(false, {short_check_interval, "exec_cxt.periodic.rate:200"});
    auto& counter = fixture.create<Counter>("Counter");
    CORBA_RTCUtil::activate(RTC::RTObject_var(counter.getObjRef()).in());
    // Through shared memory, and over CORBA alone.
    for (const std::string way : {"", "&dataflow_type=pull"})
        fixture.connect("Counter0.out?port=" + at(port) + "Reporter0.in" + way + "&allow_dup_connection=YES");
    std::vector<pid_t> helpers;
    restart(
        "Reporter,HelperForker", port, {"manager.components.preactivation:Reporter0,HelperForker0"},
        [&](RemoteHost& other) {
            const std::string text = "helper ";
            if (!other.host.wait_for_output(text)) return false;
            helpers.push_back(
                std::stoi(other.host.output.substr(other.host.output.find(text) + text.size())));
            return eventually([&] { return connection_count(counter.out_) == 2; });
        },
        [&] { return is_listening(port) ? 1 : connection_count(counter.out_); });
    CHECK(helpers.size() == lives);
    for (const pid_t helper : helpers) CHECK(kill(helper, SIGKILL) == 0); // each has outlived its host
}

TEST_CASE("A service can be called again when its process was killed and restarted") {
    const std::string port = unused_port(), here = unused_port();
    ManagerFixture fixture(false, {short_check_interval, "corba.endpoints:127.0.0.1:" + here});
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    const auto answers = [&](RemoteHost&) {
        Testing::Numbers numbers;
        numbers.length(2);
        numbers[0] = 1.5;
        numbers[1] = 2;
        return eventually([&] {
            try {
                return connection_count(consumer.port_) == 1 && consumer.calculator_->sum(numbers) == 3.5;
            } catch (const CORBA::SystemException&) {
                return false; // the reference of the life before, or not active yet
            }
        });
    };
    const auto left = [&] { return connection_count(consumer.port_); };
    const std::string activation = "manager.components.preactivation:CalculatorProvider0";
    restart("CalculatorProvider", port,
            {activation, "manager.components.preconnect:CalculatorProvider0.calculator?port=" + at(here) +
                             "CalculatorConsumer0.calculator"},
            answers, left);
    fixture.connect("CalculatorConsumer0.calculator?port=" + at(port) + "CalculatorProvider0.calculator");
    restart("CalculatorProvider", port, {activation}, answers, left);
}

TEST_CASE("A host ends cleanly however many of its peers hang") {
    const std::string port = unused_port();
    std::vector<std::unique_ptr<RemoteHost>> peers;
    std::string lines;
    for (int i = 0; i < 4; ++i) {
        peers.push_back(std::make_unique<RemoteHost>("Reporter"));
        REQUIRE(peers.back()->host.wait_for_output("ready\n"));
        lines += (i > 0 ? "," : "") + ("Counter0.out?port=" + at(peers.back()->port)) + "Reporter0.in";
    }
    RemoteHost host("Counter", port, {short_check_interval, "manager.components.preconnect:" + lines});
    REQUIRE(host.host.wait_for_output("ready\n"));
    for (auto& peer : peers) REQUIRE(peer->host.suspend());
    host.host.send_signal(SIGTERM);
    CHECK(host.host.wait_for_exit() == 0);
    CHECK_THAT(host.host.errors, !Catch::Contains("does not return")); // each component has 4 s for its end
}

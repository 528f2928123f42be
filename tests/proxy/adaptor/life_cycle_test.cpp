// SPDX-License-Identifier: Apache-2.0
// The adaptor's life cycle and that of the RTCs behind its link.
#include "scene.hpp"

#include <barrier>
#include <future>
#include <thread>

using namespace tandem;
using namespace std::chrono_literals;
using adaptor::test::Peer;
using adaptor::test::Scene;
using link::CallStatus;
using link::test::eventually;
using link::test::soon;

TEST_CASE("starting and stopping the adaptor activates and deactivates the RTC") {
    Scene scene("cycle");
    CHECK(scene.component.start() == OPROS_SUCCESS);
    CHECK(scene.peer.has_received(".bind"));
    CHECK(scene.peer.has_received(".activate"));
    CHECK(scene.component.stop() == OPROS_SUCCESS);
    CHECK(scene.peer.has_received(".deactivate"));
}

TEST_CASE("an RTC that cannot be activated keeps the adaptor from starting") {
    Scene scene("refused");
    scene.peer.refuse("activate");
    CHECK(scene.component.start() != OPROS_SUCCESS);
    CHECK(scene.component.getStatus() != OPROS_CS_ACTIVE);
}

TEST_CASE("an RTC in ERROR puts the adaptor in ERROR") {
    Scene scene("error");
    REQUIRE(scene.component.start() == OPROS_SUCCESS);
    scene.peer.link.call(
        {"", link::control::failed, "", link::control::encode_string("RTC 'Joystick0' went to ERROR")}, soon);
    CHECK(eventually([&] { return scene.component.getStatus() == OPROS_CS_ERROR; }));
}

TEST_CASE("an adaptor stays ACTIVE if a peer that has returned leaves again before the RTC is active") {
    const std::string name = fmt::format("test-adaptor-gone-{}", getpid());
    std::optional<Peer> peer(std::in_place, name);
    adaptor::AdaptorComp component;
    component.setProperty("link", name);
    REQUIRE(component.initialize() == OPROS_SUCCESS);
    REQUIRE(component.start() == OPROS_SUCCESS);
    for (const auto status : {CallStatus::peer_died, CallStatus::shut_down, CallStatus::ok}) {
        peer.reset();
        peer.emplace(name, status);
        CHECK(eventually([&] { return peer->has_received(".activate"); }));
    }
    CHECK(component.getStatus() == OPROS_CS_ACTIVE);
    component.destroy();
}

TEST_CASE("a start activates the RTC once, however late the link's thread reports the peer") {
    const std::string name = fmt::format("test-adaptor-once-{}", getpid());
    Peer peer(name, CallStatus::ok, "listen"); // which that thread asks for first
    adaptor::AdaptorComp component;
    component.setProperty("link", name);
    component.setProperty("call_timeout", "10000");
    REQUIRE(component.initialize() == OPROS_SUCCESS);
    REQUIRE(component.start() == OPROS_SUCCESS);
    REQUIRE(eventually([&] { return peer.has_received(".listen"); }));
    peer.hold("");
    // When the thread executes this task, it has finished the one before.
    struct : DataPortListener {
        void arrived() override {}
    } listener;
    InputDataPort<std::vector<double>> input;
    input.setListener(&listener);
    auto& reference = dynamic_cast<OutputDataPortInterface&>(*component.getPort("reference"));
    REQUIRE(reference.checkType(&input));
    REQUIRE(eventually([&] { return peer.count(".listen") == 2; }));
    CHECK(peer.count(".activate") == 1);
    reference.clearConnection();
    component.destroy();
}

TEST_CASE("a call_timeout that is too short for telling the peer of services prevents no activation") {
    const std::string name = fmt::format("test-adaptor-short-{}", getpid());
    Peer peer(name, CallStatus::ok, "bind");
    adaptor::AdaptorComp component;
    component.setProperty("link", name);
    component.setProperty("call_timeout", "20");
    REQUIRE(component.initialize() == OPROS_SUCCESS);
    auto start = std::async(std::launch::async, [&] { return component.start(); });
    REQUIRE(eventually([&] { return peer.has_received(".bind"); }));
    std::this_thread::sleep_for(100ms);
    peer.hold("");
    CHECK(start.get() == OPROS_SUCCESS);
    CHECK(peer.count(".activate") == 1);
    component.destroy();
}

TEST_CASE("a stop deactivates the RTC after the activation for a peer that returned") {
    const std::string name = fmt::format("test-adaptor-order-{}", getpid());
    std::optional<Peer> peer(std::in_place, name);
    adaptor::AdaptorComp component;
    component.setProperty("link", name);
    REQUIRE(component.initialize() == OPROS_SUCCESS);
    REQUIRE(component.start() == OPROS_SUCCESS);
    peer.reset();
    peer.emplace(name, CallStatus::ok, "activate");
    REQUIRE(eventually([&] { return peer->has_received(".activate"); }));
    auto stop = std::async(std::launch::async, [&] { return component.stop(); });
    std::this_thread::sleep_for(100ms); // in which it would have overtaken the activation
    CHECK_FALSE(peer->has_received(".deactivate"));
    peer->hold("");
    CHECK(stop.get() == OPROS_SUCCESS);
    CHECK(peer->count(".activate") == 1);
    CHECK(peer->has_received(".deactivate"));
    component.destroy();
}

namespace {

void report(Peer& peer, std::string_view command) {
    peer.link.call({"", command, "", link::control::encode_string("RTC 'Joystick0' went to ERROR")}, soon);
}

bool comes_to(Scene& scene, LifecycleState state) {
    return eventually([&] { return scene.component.getStatus() == state; });
}

} // namespace

TEST_CASE("an adaptor in ERROR because of an RTC is ACTIVE again when the RTCs are, and resets none") {
    Scene scene("healed");
    REQUIRE(scene.component.start() == OPROS_SUCCESS);
    report(scene.peer, link::control::failed);
    REQUIRE(comes_to(scene, OPROS_CS_ERROR));
    report(scene.peer, link::control::recovered);
    CHECK(comes_to(scene, OPROS_CS_ACTIVE));
    CHECK(scene.peer.count(".activate") == 2);
    CHECK_FALSE(scene.peer.has_received(".reset"));
}

TEST_CASE("an adaptor stays in ERROR with its RTC, however late the link's thread reports the peer") {
    const std::string name = fmt::format("test-adaptor-late-{}", getpid());
    Peer peer(name, CallStatus::ok, "listen"); // which that thread asks for first
    adaptor::AdaptorComp component;
    component.setProperty("link", name);
    component.setProperty("call_timeout", "10000");
    REQUIRE(component.initialize() == OPROS_SUCCESS);
    REQUIRE(component.start() == OPROS_SUCCESS);
    REQUIRE(eventually([&] { return peer.has_received(".listen"); }));
    peer.link.wait_until_up(soon, "adaptor");
    report(peer, link::control::failed);
    REQUIRE(eventually([&] { return component.getStatus() == OPROS_CS_ERROR; }));
    peer.hold("");
    std::this_thread::sleep_for(100ms); // in which it would have started
    CHECK(component.getStatus() == OPROS_CS_ERROR);
    CHECK(peer.count(".activate") == 1);
    component.destroy();
}

TEST_CASE("an adaptor whose start an RTC has refused is ACTIVE when the RTCs are") {
    Scene scene("late");
    scene.peer.refuse("activate");
    REQUIRE(scene.component.start() != OPROS_SUCCESS);
    scene.component.fail(); // as the host does
    scene.peer.refuse("");
    report(scene.peer, link::control::recovered);
    CHECK(comes_to(scene, OPROS_CS_ACTIVE));
}

TEST_CASE(
    "an adaptor that was stopped or recovered by the user, or failed by itself, does not start by itself") {
    const std::string what = GENERATE("stop", "recover", "fail");
    Scene scene("user");
    REQUIRE(scene.component.start() == OPROS_SUCCESS);
    if (what == "recover") report(scene.peer, link::control::failed);
    if (what == "stop") REQUIRE(scene.component.stop() == OPROS_SUCCESS);
    if (what == "recover") REQUIRE(scene.component.recover() == OPROS_SUCCESS);
    if (what == "fail") REQUIRE(scene.component.stopOnError() == OPROS_SUCCESS);
    const auto state = scene.component.getStatus();
    report(scene.peer, link::control::recovered);
    std::this_thread::sleep_for(100ms); // in which it would have started
    CHECK(scene.component.getStatus() == state);
    CHECK(scene.peer.count(".activate") == 1);
}

TEST_CASE("a stop in ERROR deactivates the RTCs, and the adaptor no longer starts by itself") {
    Scene scene("withdrawn");
    REQUIRE(scene.component.start() == OPROS_SUCCESS);
    report(scene.peer, link::control::failed);
    REQUIRE(comes_to(scene, OPROS_CS_ERROR));
    CHECK(scene.component.stop() == OPROS_SUCCESS);
    CHECK(scene.peer.has_received(".deactivate"));
    CHECK(scene.component.stop() != OPROS_SUCCESS); // no restart is wanted any more
    report(scene.peer, link::control::recovered);
    std::this_thread::sleep_for(100ms); // in which it would have started
    CHECK(scene.component.getStatus() == OPROS_CS_ERROR);
    CHECK(scene.peer.count(".activate") == 1);
}

TEST_CASE("an adaptor whose RTCs become active while the user recovers it does not start by itself") {
    Scene scene("between");
    REQUIRE(scene.component.start() == OPROS_SUCCESS);
    report(scene.peer, link::control::failed);
    REQUIRE(comes_to(scene, OPROS_CS_ERROR));
    scene.peer.hold("reset");
    auto recovery = std::async(std::launch::async, [&] { return scene.component.recover(); });
    REQUIRE(eventually([&] { return scene.peer.has_received(".reset"); }));
    auto reported = std::async(std::launch::async, [&] { report(scene.peer, link::control::recovered); });
    std::this_thread::sleep_for(100ms); // in which its restart begins to wait for the recovery
    scene.peer.hold("");
    REQUIRE(recovery.get() == OPROS_SUCCESS);
    reported.get();
    std::this_thread::sleep_for(100ms); // in which it would have started
    CHECK(scene.component.getStatus() == OPROS_CS_READY);
    CHECK(scene.peer.count(".activate") == 1);
}

TEST_CASE("an RTC that fails during a stop causes no restart, whichever comes first") {
    constexpr int rounds = 2000;
    adaptor::RunState state;
    std::barrier round(2);
    int restarts_wanted = 0;
    std::thread rtc([&] {
        for (int i = 0; i < rounds; ++i) {
            round.arrive_and_wait();
            state.fail();
            round.arrive_and_wait();
        }
    });
    for (int i = 0; i < rounds; ++i) {
        state.begin_start(false);
        state.activated();
        round.arrive_and_wait();
        state.let_user_decide();
        round.arrive_and_wait();
        restarts_wanted += state.is_restart_wanted() ? 1 : 0;
    }
    rtc.join();
    CHECK(restarts_wanted == 0);
}

TEST_CASE("a restart that was withdrawn cannot begin, and a start of the user can") {
    adaptor::RunState state;
    state.begin_start(false);
    CHECK_FALSE(state.fail()); // not yet running
    state.activated();
    CHECK_FALSE(state.end_start());
    REQUIRE(state.is_restart_wanted());
    CHECK(state.withdraw_restart());
    CHECK_FALSE(state.begin_start(true));
    CHECK(state.begin_start(false));
    state.activated();
    CHECK(state.end_start());
}

TEST_CASE(
    "an adaptor in ERROR because of an RTC activates the RTC of the next peer, and of the one after it") {
    const std::string name = fmt::format("test-adaptor-next-{}", getpid());
    std::optional<Peer> peer(std::in_place, name);
    adaptor::AdaptorComp component;
    component.setProperty("link", name);
    REQUIRE(component.initialize() == OPROS_SUCCESS);
    REQUIRE(component.start() == OPROS_SUCCESS);
    peer->link.wait_until_up(soon, "adaptor");
    report(*peer, link::control::failed);
    REQUIRE(eventually([&] { return component.getStatus() == OPROS_CS_ERROR; }));
    for (int i = 0; i < 2; ++i) {
        peer.reset();
        peer.emplace(name);
        CHECK(eventually([&] { return peer->has_received(".activate"); }));
        CHECK(eventually([&] { return component.getStatus() == OPROS_CS_ACTIVE; }));
    }
    component.destroy();
}

TEST_CASE("an adaptor in ERROR that is reset or recovered resets the RTC and activates it again") {
    const bool by_reset = GENERATE(true, false);
    Scene scene("again");
    REQUIRE(scene.component.start() == OPROS_SUCCESS);
    scene.peer.link.call({"", link::control::failed, "", link::control::encode_string("RTC went to ERROR")},
                         soon);
    REQUIRE(eventually([&] { return scene.component.getStatus() == OPROS_CS_ERROR; }));
    {
        const std::lock_guard lock(scene.peer.mutex);
        scene.peer.received.clear();
    }
    scene.peer.refuse("reset");
    CHECK((by_reset ? scene.component.reset() : scene.component.recover()) != OPROS_SUCCESS);
    CHECK(scene.component.getStatus() == OPROS_CS_ERROR);
    CHECK_FALSE(scene.peer.has_received(".activate"));
    scene.peer.refuse("");
    if (by_reset)
        CHECK(scene.component.reset() == OPROS_SUCCESS);
    else
        CHECK((scene.component.recover() == OPROS_SUCCESS && scene.component.start() == OPROS_SUCCESS));
    CHECK(scene.component.getStatus() == OPROS_CS_ACTIVE);
    CHECK(scene.peer.has_received(".reset"));
    CHECK(scene.peer.has_received(".activate"));
}

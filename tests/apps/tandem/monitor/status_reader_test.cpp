// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/status_reader.hpp"
#include "apps/tandem/monitor/verdict.hpp"
#include "host/rt/thread.hpp"
#include "host/rt/tick_page.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <memory>
#include <thread>
#include <vector>

using namespace tandem::monitor;
using namespace tandem::process;

namespace {

/// Reads what a process publishes that is one side of a link.
class Reading {
  public:
    explicit Reading(pid_t pid = getpid()) : pid_(pid) {}
    State operator()() {
        State state;
        state.links.emplace_back();
        state.links[0].name = "chair";
        for (SideState& side : state.links[0].sides)
            side = {tandem::shm::PeerState::alive, static_cast<std::uint32_t>(pid_), "test"};
        reader_.read(state, now_ns_ += 10'000'000'000);
        return state;
    }

  private:
    pid_t pid_;
    StatusReader reader_;
    std::uint64_t now_ns_ = 0;
};

/// Returns 0 if body() returned true.
int in_child_process(const std::function<bool()>& body) {
    const pid_t child = fork();
    if (child == 0) _exit(body() ? 0 : 1);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace

TEST_CASE("the states of a process's components can be read from outside while they last") {
    Reading read;
    {
        OwnComponentState arm("Arm", ComponentState::inactive);
        const OwnComponentState leg("Leg\n", ComponentState::active);
        State state = read();
        REQUIRE(state.components.size() == 2);
        CHECK(state.components[0].name == "Arm");
        CHECK(state.components[0].program == "test");
        CHECK(state.components[0].state == ComponentState::inactive);
        CHECK(state.components[1].name.find('\n') == std::string::npos);
        CHECK(judge(state).level == Level::inactive);
        arm.set(ComponentState::error);
        CHECK(judge(read()).level == Level::failed);
        arm.set(ComponentState::active);
        CHECK(judge(read()).level == Level::well);
    }
    CHECK(read().components.empty());
}

TEST_CASE("a component in ERROR is one finding, with the reason that its host publishes") {
    Reading read;
    OwnComponentState arm("Arm", ComponentState::error), leg("Leg", ComponentState::error);
    const OwnNotice of_arm(NoticeKind::component, "component Arm: onExecute threw an exception: stuck");
    const OwnNotice of_leg(NoticeKind::component, "Leg: onActivated returned 1 (RTC_ERROR)");
    const OwnNotice other(NoticeKind::component, "component Hand is left out: there is no library");
    const State state = read();
    REQUIRE(state.components.size() == 2);
    CHECK(state.components[0].reason == "onExecute threw an exception: stuck");
    CHECK(state.components[1].reason == "onActivated returned 1 (RTC_ERROR)");
    CHECK(state.notices.size() == 1);
    const Verdict verdict = judge(state);
    CHECK(verdict.findings == 3);
    CHECK(verdict.reason == "Arm in test (pid " + std::to_string(getpid()) +
                                ") is in ERROR: onExecute threw an exception: stuck");
    arm.set(ComponentState::active); // its notice is then about something else
    CHECK(read().components[0].reason.empty());
}

TEST_CASE("an event-driven component hangs if its cycle lasts longer than the hosts wait") {
    Reading read; // looks at 10 s, 20 s, ...
    OwnComponentState arm("Arm", ComponentState::active);
    arm.set_in_cycle_since(5'000'000'000);
    CHECK(judge(read()).level == Level::well);
    CHECK(judge(read()).level == Level::well);
    const Verdict verdict = judge(read());
    CHECK(verdict.level == Level::hanging);
    CHECK_THAT(verdict.reason,
               Catch::StartsWith("Arm in test") && Catch::EndsWith("its cycle has not returned for 25 s"));
    arm.set_in_cycle_since(0);
    CHECK(judge(read()).level == Level::well);
}

TEST_CASE(
    "a component in several execution contexts is in ERROR if it is in one, else active if it is in one") {
    Reading read;
    OwnComponentState own("Arm", ComponentState::inactive), other("Arm", ComponentState::active);
    REQUIRE(read().components.size() == 1);
    CHECK(read().components[0].state == ComponentState::active);
    own.set(ComponentState::error);
    CHECK(read().components[0].state == ComponentState::error);
}

TEST_CASE("components beyond the places of the file are reported as not shown") {
    Reading read;
    std::vector<std::unique_ptr<OwnComponentState>> many;
    for (std::size_t i = 0; i < ComponentStates::places + 2; ++i)
        many.push_back(
            std::make_unique<OwnComponentState>("Arm" + std::to_string(i), ComponentState::active));
    const State state = read();
    CHECK(state.components.size() == ComponentStates::places);
    REQUIRE(state.unseen.size() == 1);
    CHECK_THAT(state.unseen[0], Catch::Contains("of 2 further components"));
    CHECK(judge(state).level == Level::unseen);
    many.clear();
    CHECK(judge(read()).level == Level::well);
}

TEST_CASE("ticks beyond the slots of the page are reported as not shown") {
    Reading read;
    std::vector<std::unique_ptr<tandem::rt::OwnTickSlot>> many;
    for (std::size_t i = 0; i < tandem::rt::TickPage::slots; ++i)
        many.push_back(std::make_unique<tandem::rt::OwnTickSlot>("Arm", 10'000'000));
    CHECK(judge(read()).level == Level::well);
    many.push_back(std::make_unique<tandem::rt::OwnTickSlot>("Leg", 10'000'000));
    const Verdict verdict = judge(read());
    CHECK(verdict.level == Level::unseen);
    CHECK_THAT(verdict.reason, Catch::Contains("the ticks of Leg are not shown"));
}

TEST_CASE("notices of a process can be read from outside while they last") {
    Reading read;
    {
        const OwnNotice left_out(NoticeKind::component, "component Arm is left out");
        const State state = read();
        REQUIRE(state.notices.size() == 1);
        CHECK(state.notices[0].text == "component Arm is left out");
        CHECK(judge(state).level == Level::failed);
    }
    CHECK(read().notices.empty());
}

TEST_CASE("a priority or processor that the kernel refuses is one notice, however many threads ask") {
    const int code = in_child_process([] { // the notices last as long as their process
        for (int i = 0; i < 2; ++i)
            std::thread([] {
                // No kernel grants priority 100 or processor 100000.
                tandem::rt::configure_this_thread({"fast", 100, 100000});
            }).join();
        const State state = Reading()();
        return state.notices.size() == 2 && judge(state).level == Level::setting &&
               state.notices[0].text.find("without SCHED_FIFO priority 100") != std::string::npos &&
               state.notices[1].text.find("not pinned to processor 100000") != std::string::npos;
    });
    CHECK(code == 0);
}

TEST_CASE("a host of another pid namespace is reported as partly unseen") {
    State state;
    state.links.emplace_back();
    state.links[0].name = "chair";
    for (SideState& side : state.links[0].sides) side.state = tandem::shm::PeerState::alive;
    state.links[0].sides[1].pid_elsewhere = 7;
    StatusReader().read(state, 1);
    REQUIRE(state.unseen.size() == 1);
    CHECK_THAT(state.unseen[0], Catch::Contains("pid 7 of another namespace"));
    CHECK(judge(state).level == Level::unseen);
}

TEST_CASE("a host whose files belong to another user is reported as partly unseen") {
    if (geteuid() != 0) TANDEM_SKIP("only root can become another user");
    const int code = in_child_process([] {
        if (setuid(65534) != 0) return false;
        const State state = Reading(getppid())();
        return state.unseen.size() == 1 && judge(state).level == Level::unseen;
    });
    CHECK(code == 0);
}

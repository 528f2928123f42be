// SPDX-License-Identifier: Apache-2.0
// Joining, creating, leaving and tidying up, killed between any two system calls.
#include "system_call_points.hpp"
#include "tests/support/skip.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A generation whose holder was killed.
void leave_a_corpse(const Link& link, Side side) {
    Child dies([&] {
        auto segment = join(link, side, small(4096));
        kill(getpid(), SIGKILL);
        return 0;
    });
    dies.wait();
}

struct Scenario {
    const char* name;
    bool survivor;    // whether the other side is there all the time
    bool corpse;      // a dead generation exists
    bool joined;      // whether the side that dies has already joined when the points begin
    const char* what; // join, leave, join and leave
};

const std::vector<Scenario> scenarios = {
    {"creating the first generation", false, false, false, "join"},
    {"creating beside a dead generation", false, true, false, "join"},
    {"joining the other side", true, false, false, "join"},
    {"leaving the other side alone", true, false, true, "leave"},
    {"leaving as the last", false, false, true, "leave"},
    {"removing the dead", false, true, false, "remove"},
};

} // namespace

TEST_CASE("a side killed between any two system calls of join or leave is dead, and nothing of it remains") {
    if (!Stepped::possible()) TANDEM_SKIP("this process may not trace its children");
    for (const auto& scenario : scenarios) {
        unsigned points = 0;
        for (bool died = true; died; ++points) {
            Link link;
            if (scenario.corpse) leave_a_corpse(link, Side::second);
            std::unique_ptr<Segment> survivor, mine;
            if (scenario.survivor) survivor = join(link, Side::first, small(4096));
            const std::string what = scenario.what;
            Stepped stepped(
                points + 1,
                [&] {
                    if (scenario.joined) mine = join(link, Side::second, small(4096));
                },
                [&] {
                    if (what == "join") mine = join(link, Side::second, small(4096));
                    if (what == "leave") mine->leave();
                    if (what == "remove") remove_dead(link.name);
                });
            died = stepped.died();
            CAPTURE(scenario.name, points, stepped.point());
            REQUIRE(stepped.result() == 0);
            if (survivor)
                CHECK((survivor->peer_state() == PeerState::dead ||
                       survivor->peer_state() == PeerState::absent));

            // The side that died comes back, and both meet.
            auto back = join(link, Side::second, small(4096));
            if (!survivor || survivor->superseded()) {
                survivor.reset();
                survivor = join(link, Side::first, small(4096));
            }
            CHECK(survivor->generation() == back->generation());
            CHECK(survivor->peer_state() == PeerState::alive);
            CHECK(back->peer_state() == PeerState::alive);
            CHECK(link.files().size() == 1);
            back.reset();
            survivor.reset();
            CHECK(link.files().empty());
        }
        CHECK(points > 1);
        if (std::getenv("TANDEM_POINTS") != nullptr)
            std::printf("%s: %u points\n", scenario.name, points - 1);
    }
}

TEST_CASE("a survivor who leaves removes what a side killed anywhere in join has left") {
    if (!Stepped::possible()) TANDEM_SKIP("this process may not trace its children");
    const bool corpse = GENERATE(false, true);
    bool died = true;
    for (unsigned k = 1; died; ++k) {
        Link link;
        if (corpse) leave_a_corpse(link, Side::second);
        auto survivor = join(link, Side::first, small(4096));
        Stepped stepped(
            k, [] {}, [&] { Segment::join(link.name, Side::second, small(4096)).release(); });
        died = stepped.died();
        CAPTURE(k, stepped.point());
        REQUIRE(stepped.result() == 0);
        survivor.reset();
        CHECK(link.files().empty());
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

#include "shm/segment/watcher.hpp"

#include <sys/resource.h>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A wait that ends for another reason (an earlier event) is repeated: only the condition counts.
bool wakes_until(Watcher& watcher, const std::function<bool()>& holds) {
    for (int wakes = 0; wakes < 50 && !holds(); ++wakes)
        if (!watcher.wait(10s)) return false;
    return eventually(holds, 1s);
}

} // namespace

TEST_CASE("a watcher wakes when a segment of its link appears and when it goes") {
    Link link;
    Watcher watcher(link.name);
    CHECK_FALSE(watcher.wait(1ms));
    auto first = join(link, Side::first);
    CHECK(watcher.wait(10s));
    while (watcher.wait(1ms)) {
    }
    first.reset();
    CHECK(watcher.wait(10s));
}

TEST_CASE("a watcher does not wake for other links") {
    Link link, stranger;
    stranger.name = link.name + "-more";
    Watcher watcher(link.name);
    auto first = join(stranger, Side::first);
    CHECK_FALSE(watcher.wait(20ms));
}

TEST_CASE("a watcher wakes when the peer joins late or is killed whether it created or attached") {
    const bool peer_creates = GENERATE(true, false);
    Link link;
    Watcher watcher(link.name);
    std::unique_ptr<Segment> first;
    if (!peer_creates) first = join(link, Side::first);
    Child second([&] {
        auto segment = join(link, Side::second);
        for (;;) pause();
        return 0;
    });
    if (peer_creates) {
        REQUIRE(wakes_until(watcher, [&] { return !link.files().empty(); }));
        first = join(link, Side::first);
    }
    REQUIRE(eventually([&] { return first->peer_state() != PeerState::absent; }));
    while (watcher.wait(1ms)) {
    }
    kill(second.pid(), SIGKILL);
    CHECK(watcher.wait(10s));
    CHECK(eventually([&] { return first->peer_state() == PeerState::dead; }));
}

TEST_CASE("looking for the dead does not wake watchers") {
    Link link;
    auto first = join(link, Side::first);
    Watcher watcher(link.name);
    remove_dead(link.name);
    CHECK_THROWS_AS(join(link, Side::first), SideTaken);
    first->superseded();
    first->peer_state();
    CHECK_FALSE(watcher.wait(20ms));
}

TEST_CASE("a watcher that cannot be had is refused in one line that names the limits") {
    Child poor([] {
        const rlimit none{0, 0};
        setrlimit(RLIMIT_NOFILE, &none);
        try {
            Watcher watcher("nobody");
        } catch (const Error& refused) {
            const std::string text = refused.what();
            return text.find("cannot be watched (Too many open files)") != std::string::npos ? 42 : 1;
        }
        return 2;
    });
    CHECK(poor.wait() == 42);
}

TEST_CASE("an interrupt ends a watcher's wait even if it came before") {
    Link link;
    Watcher watcher(link.name);
    watcher.interrupt();
    CHECK(watcher.wait(10s));
    std::thread other([&] { watcher.interrupt(); });
    CHECK(watcher.wait(10s));
    other.join();
}

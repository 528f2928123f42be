// SPDX-License-Identifier: Apache-2.0
// Races of restarts and starts: which side ends up in which generation.
#include "tests/shm/fixture.hpp"

#include "shm/segment/liveness.hpp"

#include <fcntl.h>
#include <sys/resource.h>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A process that joins and then stays until it is killed.
Child stays_in(const Link& link, Side side) {
    Child child([&] {
        auto segment = join(link, side);
        for (;;) pause();
        return 0;
    });
    return child;
}

bool held(const Link& link, Side side) {
    for (const auto generation : list_generations(link.name))
        if (probe_segment(segment_path(link.name, generation)).held[index_of(side)]) return true;
    return false;
}

} // namespace

TEST_CASE("a killed peer is dead at once and nothing is left after the survivor leaves") {
    Link link;
    auto first = join(link, Side::first);
    Child second = stays_in(link, Side::second);
    REQUIRE(eventually([&] { return first->peer_state() == PeerState::alive; }));
    second.kill_now();
    CHECK(first->peer_state() == PeerState::dead);
    first.reset();
    CHECK(link.files().empty());
}

TEST_CASE("a stopped peer is alive") {
    Link link;
    auto first = join(link, Side::first);
    Child second = stays_in(link, Side::second);
    REQUIRE(eventually([&] { return first->peer_state() != PeerState::absent; }));
    REQUIRE(kill(second.pid(), SIGSTOP) == 0);
    std::this_thread::sleep_for(30ms);
    CHECK(first->peer_state() == PeerState::alive);
}

TEST_CASE("when either side restarts, the survivor is superseded and both meet in the next generation") {
    const Side restarts = GENERATE(Side::first, Side::second);
    Link link;
    std::unique_ptr<Segment> survivor;
    std::uint64_t before = 0;
    {
        Child dies = stays_in(link, restarts);
        REQUIRE(eventually([&] { return held(link, restarts); }));
        survivor = join(link, other(restarts));
        before = survivor->generation();
        CHECK(survivor->peer_state() != PeerState::dead);
        dies.kill_now();
    }
    CHECK(survivor->peer_state() == PeerState::dead);
    CHECK_FALSE(survivor->superseded());
    auto restarted = join(link, restarts);
    CHECK(restarted->generation() > before);
    CHECK(restarted->peer_state() == PeerState::absent);
    CHECK(survivor->superseded());
    survivor.reset();
    survivor = join(link, other(restarts));
    CHECK(survivor->generation() == restarted->generation());
    CHECK(restarted->peer_state() == PeerState::alive);
    CHECK(link.files().size() == 1);
}

TEST_CASE("when both sides die, either may return first and finds no trace of the old generation") {
    const Side back_first = GENERATE(Side::first, Side::second);
    Link link;
    {
        Child one = stays_in(link, Side::first);
        Child two = stays_in(link, Side::second);
        REQUIRE(eventually([&] { return held(link, Side::first) && held(link, Side::second); }));
    }
    CHECK(link.files().size() == 1);
    auto one = join(link, back_first);
    auto two = join(link, other(back_first));
    CHECK(one->generation() == two->generation());
    CHECK(one->peer_state() == PeerState::alive);
    CHECK(link.files().size() == 1);
}

TEST_CASE("remove_dead() removes what killed processes left behind and nothing else") {
    Link link;
    Link longer;
    longer.name = link.name + "-x";
    auto neighbour = join(longer, Side::first);
    {
        Child one = stays_in(link, Side::first);
        Child two = stays_in(link, Side::second);
        REQUIRE(eventually([&] { return held(link, Side::first) && held(link, Side::second); }));
        remove_dead(link.name);
        CHECK(link.files().size() == 1);
        one.kill_now();
        remove_dead(link.name);
        CHECK(link.files().size() == 1);
    }
    remove_dead(link.name);
    CHECK(link.files().empty());
    CHECK(longer.files().size() == 1);
}

TEST_CASE("a file that was removed by hand counts as superseded") {
    Link link;
    auto first = join(link, Side::first);
    std::filesystem::remove(first->path());
    CHECK(first->superseded());
}

TEST_CASE("a process stopped while it joins does not hold up the other side for long") {
    Link link;
    auto first = join(link, Side::first);
    const FileDescriptor stopped(open(first->path().c_str(), O_RDWR | O_CLOEXEC));
    REQUIRE(try_lock(stopped.get(), LockByte::hand_over));
    auto second = join(link, Side::second);
    CHECK(second->generation() == first->generation() + 1);
    CHECK(first->superseded());
}

TEST_CASE("a side leaves a segment without a name at once, even if a process stopped while it joined") {
    Link link;
    auto first = join(link, Side::first);
    const FileDescriptor stopped(open(first->path().c_str(), O_RDWR | O_CLOEXEC));
    REQUIRE(try_lock(stopped.get(), LockByte::hand_over));
    std::filesystem::remove(first->path());
    rusage before{}, after{};
    getrusage(RUSAGE_THREAD, &before);
    first.reset();
    getrusage(RUSAGE_THREAD, &after);
    CHECK(after.ru_nvcsw - before.ru_nvcsw <= 2); // waiting for the lock sleeps some thousand times
}

TEST_CASE("a side that needs a larger arena makes the next generation large enough for both") {
    Link link;
    auto first = join(link, Side::first, small(64 * 1024));
    auto second = join(link, Side::second, small(256 * 1024));
    CHECK(second->generation() == first->generation() + 1);
    REQUIRE(first->superseded());
    first.reset();
    first = join(link, Side::first, small(64 * 1024));
    CHECK(first->generation() == second->generation());
    CHECK(first->add_blob("b", 200 * 1024).size() == 200 * 1024);
}

TEST_CASE("a file whose name appears and disappears while it is opened is open or absent, and no error") {
    const Link link;
    const auto created = join(link, Side::first);
    const std::string path = segment_path(link.name, 2);
    std::atomic<bool> done{false};
    std::thread changes([&] {
        while (!done) {
            std::filesystem::create_hard_link(created->path(), path);
            std::filesystem::remove(path);
        }
    });
    std::size_t errors = 0;
    for (std::size_t i = 0; i < stress(100'000); ++i) {
        try {
            open_segment(path, access_of_this_process(""));
        } catch (const Error&) {
            ++errors;
        }
    }
    done = true;
    changes.join();
    CHECK(errors == 0);
}

TEST_CASE("if many processes join at once, exactly one pair meets") {
    const std::size_t rounds = stress(10, 200);
    for (std::size_t round = 0; round < rounds; ++round) {
        Link link;
        int gate[2], results[2];
        REQUIRE((pipe(gate) == 0 && pipe(results) == 0));
        std::vector<Child> children;
        for (int i = 0; i < 8; ++i) {
            children.emplace_back([&] {
                const Side side = i % 2 == 0 ? Side::first : Side::second;
                char go = 0;
                close(gate[1]);
                [[maybe_unused]] auto end = read(gate[0], &go, 1); // ends for all at once
                std::uint64_t generation = 0;
                std::unique_ptr<Segment> segment;
                try {
                    segment = join(link, side);
                    generation = segment->generation();
                } catch (const SideTaken&) {
                }
                [[maybe_unused]] auto sent = write(results[1], &generation, sizeof generation);
                for (;;) pause();
                return 0;
            });
        }
        close(gate[0]);
        close(gate[1]);
        std::vector<std::uint64_t> joined;
        for (int i = 0; i < 8; ++i) {
            std::uint64_t generation = 0;
            REQUIRE(read(results[0], &generation, sizeof generation) == sizeof generation);
            if (generation != 0) joined.push_back(generation);
        }
        close(results[0]);
        close(results[1]);
        CHECK(joined.size() == 2);
        if (joined.size() == 2) CHECK(joined[0] == joined[1]);
        CHECK(link.files().size() == 1);
        children.clear();
        remove_dead(link.name);
        CHECK(link.files().empty());
    }
}

TEST_CASE("two sides that restart again and again at the same time always meet") {
    Link link;
    std::atomic<int> meetings{0};
    const int rounds = static_cast<int>(stress(100));
    // Each side joins, waits until the peer has joined, and leaves; a superseded side starts again.
    const auto run = [&](Side side) {
        for (int met = 0; met < rounds;) {
            auto segment = join(link, side, small(4096));
            const auto deadline = deadline_after(5s);
            bool there = false;
            while (!there && !segment->superseded() && now_ns() < deadline) {
                const PeerState peer = segment->peer_state();
                if (peer == PeerState::dead) break;
                there = peer != PeerState::absent;
                std::this_thread::yield();
            }
            if (there) ++met, ++meetings;
            if (now_ns() >= deadline) return;
        }
    };
    std::thread one(run, Side::first), two(run, Side::second);
    one.join();
    two.join();
    CHECK(meetings > rounds);
    CHECK(link.files().empty());
}

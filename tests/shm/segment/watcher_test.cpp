// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

#include "shm/segment/watcher.hpp"
#include "tests/support/context_switches.hpp"

#include <thread>

#include <fcntl.h>
#include <sys/resource.h>

using namespace tandem::shm;
using namespace tandem::shm::test;

using Event = Watcher::Event;

namespace {

/// Watches the generation that `segment` has joined.
struct Watched : Watcher {
    Watched(const Link& link, const Segment& segment) : Watcher(link.name) { segment.watch(*this); }
    /// Takes what has happened so far; each event is reported at once.
    void take_all() {
        while (wait(1ms) != Event::none) {
        }
    }
};

} // namespace

TEST_CASE("a watcher wakes when a peer joins, publishes and leaves") {
    Link link;
    auto first = join(link, Side::first);
    Watched watcher(link, *first);
    CHECK(watcher.wait(1ms) == Event::none);
    auto second = join(link, Side::second);
    CHECK(watcher.wait(10s) == Event::changed);
    watcher.take_all();
    second->publish();
    CHECK(watcher.wait(10s) == Event::changed);
    watcher.take_all();
    second->leave(); // its memory stays mapped and its file open
    CHECK(watcher.wait(10s) == Event::changed);
    CHECK(first->peer_state() == PeerState::dead);
}

TEST_CASE("all watchers of a process share one inotify instance and each wakes for its own file") {
    constexpr std::size_t links = 40;
    const auto inotify_instances = [] {
        std::size_t count = 0;
        for (const auto& fd : std::filesystem::directory_iterator("/proc/self/fd")) {
            std::error_code closed_meanwhile;
            count += std::filesystem::read_symlink(fd, closed_meanwhile) == "anon_inode:inotify" ? 1 : 0;
        }
        return count;
    };
    std::vector<std::unique_ptr<Link>> names;
    std::vector<std::unique_ptr<Segment>> first, second;
    std::vector<std::unique_ptr<Watched>> watchers;
    for (std::size_t i = 0; i < links; ++i) {
        names.push_back(std::make_unique<Link>());
        first.push_back(join(*names[i], Side::first));
        watchers.push_back(std::make_unique<Watched>(*names[i], *first[i]));
    }
    CHECK(inotify_instances() == 1);
    for (std::size_t i = 0; i < links; ++i) second.push_back(join(*names[i], Side::second));
    CHECK(watchers[7]->wait(10s) == Event::changed); // it reads what has come for all
    for (std::size_t i = 0; i < links; ++i)
        if (i != 7) CHECK(watchers[i]->wait(10s) == Event::changed);
    for (const auto& watcher : watchers) watcher->take_all();
    second[3]->publish();
    CHECK(watchers[5]->wait(1ms) == Event::none);
    CHECK(watchers[3]->wait(10s) == Event::changed);
    watchers.clear();
    CHECK(inotify_instances() == 0);
}

TEST_CASE("an event of one of many links wakes the thread of that link, and at most one other") {
    constexpr std::size_t links = 40;
    constexpr int events = 50;
    std::vector<std::unique_ptr<Link>> names;
    std::vector<std::unique_ptr<Segment>> first;
    std::vector<std::unique_ptr<Watched>> watchers;
    std::vector<std::atomic<int>> seen(links);
    std::atomic<bool> ends{false};
    std::vector<std::thread> threads;
    const auto close = [&] {
        ends = true;
        for (const auto& watcher : watchers) watcher->interrupt();
        for (auto& thread : threads) thread.join();
    };
    for (std::size_t i = 0; i < links; ++i) {
        names.push_back(std::make_unique<Link>());
        first.push_back(join(*names[i], Side::first));
        watchers.push_back(std::make_unique<Watched>(*names[i], *first[i]));
    }
    for (std::size_t i = 0; i < links; ++i)
        threads.emplace_back([&, i] {
            pthread_setname_np(pthread_self(), "watch");
            while (!ends)
                if (watchers[i]->wait(60s) != Event::none) ++seen[i];
        });
    const auto switches = [] {
        long sum = 0;
        for (const auto& [thread, count] : tandem::test::count_context_switches(getpid()))
            if (thread.find("watch") != std::string::npos) sum += count;
        return sum;
    };
    std::this_thread::sleep_for(100ms); // until they sleep
    const long before = switches();
    bool complete = true;
    for (int i = 0; i < events && complete; ++i) {
        const std::size_t which = (7 * static_cast<std::size_t>(i)) % links;
        const int last = seen[which];
        first[which]->publish();
        complete = eventually([&] { return seen[which] > last; });
    }
    const long woken = switches() - before;
    close();
    CHECK(complete);
    INFO(woken);
    CHECK(woken <=
          4 * events); // not links * events: two threads, each with a switch for the lock now and then
}

TEST_CASE("a watcher that ends passes on the events of the others") {
    Link one, other;
    auto first = join(one, Side::first), second = join(other, Side::first);
    auto ending = std::make_unique<Watched>(one, *first);
    Watched stays(other, *second);
    ending->take_all();
    stays.take_all();
    std::atomic<bool> seen{false};
    second->publish();
    ending.reset(); // it has read what has come, or nobody has
    std::thread waiting([&] { seen = stays.wait(10s) == Event::changed; });
    waiting.join();
    CHECK(seen);
}

TEST_CASE("a watcher wakes when its file is truncated, superseded or removed") {
    Link link;
    auto first = join(link, Side::first);
    Watched watcher(link, *first);
    SECTION("truncated") {
        install_truncation_guard(); // leaving touches what is lost
        REQUIRE(truncate(first->path().c_str(), 4096) == 0);
    }
    SECTION("superseded") {
        const int fd = open(first->path().c_str(), O_WRONLY | O_CLOEXEC);
        const std::uint64_t newer = first->generation() + 1;
        REQUIRE(pwrite(fd, &newer, sizeof newer, offsetof(layout::SegmentHeader, superseded_by)) ==
                sizeof newer);
        close(fd);
    }
    SECTION("removed") { REQUIRE(unlink(first->path().c_str()) == 0); }
    CHECK(watcher.wait(10s) != Event::none);
    CHECK(first->superseded());
}

TEST_CASE("a watcher wakes neither for other links nor for stores to memory") {
    Link link, stranger;
    stranger.name = link.name + "-more";
    auto first = join(link, Side::first), second = join(link, Side::second);
    Watched watcher(link, *first);
    auto other_link = join(stranger, Side::first);
    other_link.reset();
    second->add_blob("b", 100)[0] = std::byte{1};
    second->ring_peer(3);
    CHECK(watcher.wait(20ms) == Event::none);
}

TEST_CASE("a watcher that watches another generation forgets the last one") {
    Link link, next;
    auto first = join(link, Side::first);
    Watched watcher(link, *first);
    auto second = join(next, Side::first);
    second->watch(watcher);
    watcher.take_all();
    first->publish();
    CHECK(watcher.wait(20ms) == Event::none);
    second->publish();
    CHECK(watcher.wait(10s) == Event::changed);
    watcher.stop_watching();
    second->publish();
    CHECK(watcher.wait(20ms) == Event::none);
}

TEST_CASE("a watcher sees a departure when the peer is killed whether it created or attached") {
    const bool peer_creates = GENERATE(true, false);
    const bool by_process = GENERATE(true, false);
    Link link;
    std::unique_ptr<Segment> first;
    if (!peer_creates) first = join(link, Side::first);
    Child second([&] {
        auto segment = join(link, Side::second);
        for (;;) pause();
        return 0;
    });
    if (peer_creates) {
        REQUIRE(eventually([&] { return !link.files().empty(); }));
        first = join(link, Side::first);
    }
    REQUIRE(eventually([&] { return first->peer_state() != PeerState::absent; }));
    Watched watcher(link, *first);
    if (by_process) {
        watcher.stop_watching();
        REQUIRE_FALSE(watcher.watch_process(first->peer_process().pid));
    }
    kill(second.pid(), SIGKILL);
    REQUIRE(watcher.wait(10s) == Event::departed);
    // The end of the process comes after that of its locks, the closing of the file before.
    if (by_process)
        CHECK(first->peer_state() == PeerState::dead);
    else
        CHECK(eventually([&] { return first->peer_state() == PeerState::dead; }));
    if (by_process) CHECK(watcher.wait(20ms) == Event::none); // once only
}

TEST_CASE("a process that does not exist cannot be watched") {
    Link link;
    Watcher watcher(link.name);
    CHECK(watcher.watch_process(0x7fffffff) == ESRCH);
    CHECK(watcher.wait(1ms) == Event::none);
}

TEST_CASE("probing for dead segments does not wake watchers") {
    Link link;
    auto first = join(link, Side::first);
    Watched watcher(link, *first);
    remove_dead(link.name);
    CHECK_THROWS_AS(join(link, Side::first), SideTaken);
    first->superseded();
    first->peer_state();
    CHECK(watcher.wait(20ms) == Event::none);
}

TEST_CASE("a watcher beyond the system's limits is refused in one line that names the limits") {
    Child poor([] {
        // UBSan asks the kernel about an object of a new type, for which it opens a pipe: the first Watcher shows it those of a
        // Watcher, and what is thrown is looked at with files again.
        { Watcher first("nobody"); }
        rlimit some{};
        getrlimit(RLIMIT_NOFILE, &some);
        const rlimit none{0, some.rlim_max};
        setrlimit(RLIMIT_NOFILE, &none);
        try {
            Watcher watcher("nobody");
        } catch (const Error& refused) {
            setrlimit(RLIMIT_NOFILE, &some);
            const std::string text = refused.what();
            return text.find("cannot be watched (Too many open files)") != std::string::npos ? 42 : 1;
        }
        return 2;
    });
    CHECK(poor.wait() == 42);
}

TEST_CASE("an interrupt ends a watcher's wait even if it came before the wait") {
    Link link;
    Watcher watcher(link.name);
    watcher.interrupt();
    CHECK(watcher.wait(10s) == Event::changed);
    std::thread other([&] { watcher.interrupt(); });
    CHECK(watcher.wait(10s) == Event::changed);
    other.join();
}

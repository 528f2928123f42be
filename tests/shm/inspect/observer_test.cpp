// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/observer.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/segment/watcher.hpp"
#include "tests/shm/fixture.hpp"
#include "tests/support/skip.hpp"

#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void overwrite(const std::string& path, std::size_t place, const std::string& bytes) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(place));
    file << bytes;
}

Observation observed(const Link& link) {
    auto seen = observe(link.name);
    REQUIRE(seen);
    return std::move(*seen);
}

/// A pair with one object of each kind on the first side.
struct Furnished : Pair {
    RingHandle ring = first->add_ring("data", {.max_record = 100, .capacity = 1024});
    CallQueueHandle queue =
        first->add_call_queue("calls", {.callers = Side::second, .slots = 3, .max_bytes = 200});
    Furnished() {
        first->add_blob("table", 77);
        first->publish();
    }
};

std::size_t directory_of(Side side) {
    return sizeof(layout::SegmentHeader) + index_of(side) * sizeof(layout::SideHeader) +
           offsetof(layout::SideHeader, directory);
}

} // namespace

TEST_CASE("an observer sees both sides and the objects of a segment") {
    const Furnished pair;
    const auto seen = observed(pair.link);
    CHECK(seen.segment.readability == Readability::readable);
    CHECK(seen.segment.generation == pair.first->generation());
    CHECK(seen.segment.path == pair.first->path());
    CHECK(seen.segment.owner == geteuid());
    for (const Side side : {Side::first, Side::second}) {
        CHECK(seen.segment.side(side).held);
        CHECK(seen.segment.side(side).pid == static_cast<std::uint32_t>(getpid()));
        CHECK(seen.segment.side(side).state != PeerState::absent);
        CHECK(seen.segment.side(side).state != PeerState::dead);
    }
    CHECK(seen.segment.side(Side::first).published);
    CHECK_FALSE(seen.segment.side(Side::second).published);
    REQUIRE(seen.rings.size() == 1);
    CHECK(seen.rings[0].name == "data");
    CHECK(seen.rings[0].owner == Side::first);
    CHECK(seen.rings[0].max_record == 100);
    CHECK(seen.rings[0].capacity >= 1024);
    CHECK(seen.rings[0].damage.empty());
    REQUIRE(seen.call_queues.size() == 1);
    CHECK(seen.call_queues[0].callers == Side::second);
    CHECK(seen.call_queues[0].slots == 3);
    CHECK(seen.call_queues[0].max_bytes == 200);
    CHECK(seen.call_queues[0].damage.empty());
    REQUIRE(seen.blobs.size() == 1);
    CHECK(seen.blobs[0].bytes == 77);
    CHECK(seen.damage.empty());
}

TEST_CASE("an observer reads the counters that the two ends keep") {
    Furnished pair;
    RingWriter writer(pair.ring);
    RingReader reader(*pair.second->find_ring(Side::first, "data"));
    const std::string text = "0123456789";
    for (int i = 0; i < 5; ++i) REQUIRE(writer.write(bytes_of(text), 0));
    REQUIRE_FALSE(writer.write(bytes_of(std::string(200, 'x')), 0));
    REQUIRE(reader.read());
    const auto seen = observed(pair.link);
    const auto expected = writer.counters();
    const auto& counters = seen.rings.at(0).counters;
    CHECK(counters.sent == expected.sent);
    CHECK(counters.refused == 1);
    CHECK(counters.received == 1);
    CHECK(counters.bytes_sent == expected.bytes_sent);
    CHECK(counters.bytes_received == text.size());
    CHECK(seen.rings.at(0).counters.waiting() == expected.sent - 2);
    CHECK(seen.call_queues.at(0).counters.calls == 0);
    CHECK(seen.call_queues.at(0).counters.in_use == 0);
}

TEST_CASE("an observer reads the counters and times of calls") {
    Furnished pair;
    CallServer server(pair.queue);
    CallClient client(*pair.second->find_call_queue(Side::first, "calls"));
    constexpr std::uint64_t calls = 50;
    std::thread worker([&] {
        for (std::uint64_t i = 0; i < calls; ++i)
            if (auto call = server.take(20s)) call->reply(CallStatus::ok, call->arguments());
    });
    std::uint64_t good = 0;
    for (std::uint64_t i = 0; i < calls; ++i)
        good += client.call(bytes_of("arguments"), 20s).status == CallStatus::ok;
    worker.join();
    CHECK(client.call({}, 1ms).status == CallStatus::timeout);

    const auto seen = observed(pair.link);
    const auto& queue = seen.call_queues.at(0);
    CHECK(good == calls);
    CHECK(queue.damage.empty());
    CHECK(queue.counters.calls == calls + 1);
    CHECK(queue.counters.answered == calls);
    CHECK(queue.counters.timeouts == 1);
    CHECK(queue.counters.in_use == 0);
    CHECK(queue.service.total() == calls);
    CHECK(queue.round_trip.total() == calls);
    CHECK(queue.round_trip.percentile(0.5) > 0);
    CHECK(queue.round_trip.percentile(0.5) <= queue.round_trip.percentile(1));
}

TEST_CASE("an observer sees unanswered calls and their progress") {
    Furnished pair;
    CallServer server(pair.queue);
    CallClient client(*pair.second->find_call_queue(Side::first, "calls"));
    std::thread caller([&] { client.call({}, 300s); });
    const auto open_calls = [&] { return observed(pair.link).call_queues.at(0).open_calls; };
    CHECK(eventually([&] { return open_calls().size() == 1; }));
    CHECK(open_calls().at(0).stage == CallStage::waiting);
    auto running = server.take(20s);
    REQUIRE(running);
    CHECK(open_calls().at(0).stage == CallStage::running);
    CHECK_FALSE(open_calls().at(0).progress);
    running->set_progress(0.25);
    CHECK(open_calls().at(0).progress == 0.25);
    CHECK(open_calls().at(0).submitted_ns <= now_ns());
    client.shut_down();
    caller.join();
    CHECK(open_calls().at(0).stage == CallStage::given_up);
    running->reply(CallStatus::ok);
    CHECK(open_calls().empty());
}

TEST_CASE("a percentile is the end of the bucket in which it falls") {
    HistogramCounts times;
    CHECK(times.percentile(0.5) == 0);
    using layout::Histogram;
    times.counts[Histogram::bucket_of(1000)] = 98;
    times.counts[Histogram::bucket_of(50'000)] = 1;
    times.counts[Histogram::buckets - 1] = 1;
    CHECK(times.total() == 100);
    CHECK(times.percentile(0) == 1024);
    CHECK(times.percentile(0.98) == 1024);
    CHECK(times.percentile(0.99) > 50'000);
    CHECK(times.percentile(0.99) <= 62'500);
    CHECK(times.percentile(1) == Histogram::lower_bound_of(Histogram::buckets - 1));
}

TEST_CASE("an observer takes no process for a side of another pid namespace") {
    Pair pair;
    Child namesake([] {
        for (;;) pause();
        return 0;
    });
    REQUIRE(kill(namesake.pid(), SIGSTOP) == 0);
    const auto write_word = [&](std::size_t place, const auto& word) {
        overwrite(pair.first->path(), sizeof(layout::SegmentHeader) + place,
                  {reinterpret_cast<const char*>(&word), sizeof word});
    };
    write_word(offsetof(layout::SideHeader, pid), static_cast<std::uint32_t>(namesake.pid()));
    write_word(offsetof(layout::SideHeader, pid_namespace), std::uint64_t{7});
    const auto elsewhere = observed(pair.link).segment.side(Side::first);
    CHECK(elsewhere.state == PeerState::alive);
    CHECK(elsewhere.pid == 0);
    CHECK(elsewhere.pid_elsewhere == static_cast<std::uint32_t>(namesake.pid()));
    const auto here = observed(pair.link).segment.side(Side::second);
    CHECK(here.pid == static_cast<std::uint32_t>(getpid()));
    CHECK(here.pid_elsewhere == 0);
}

TEST_CASE("an observer distinguishes absent, alive, stopped and dead sides") {
    const Link link;
    auto first = join(link, Side::first);
    CHECK(observed(link).segment.side(Side::first).state == PeerState::alive);
    CHECK(observed(link).segment.side(Side::second).state == PeerState::absent);
    {
        Child stopped([&] {
            auto segment = join(link, Side::second);
            for (;;) pause();
            return 0;
        });
        const auto state = [&] { return observed(link).segment.side(Side::second).state; };
        REQUIRE(eventually([&] { return state() == PeerState::alive; }));
        REQUIRE(kill(stopped.pid(), SIGSTOP) == 0);
        CHECK(eventually([&] { return state() == PeerState::stopped; }));
        REQUIRE(kill(stopped.pid(), SIGCONT) == 0);
        CHECK(eventually([&] { return state() == PeerState::alive; }));
        stopped.kill_now();
        CHECK(state() == PeerState::dead);
        CHECK_FALSE(observed(link).segment.side(Side::second).left);
    }
    first.reset(); // the generation of a dead side is never joined again
    first = join(link, Side::first);
    auto second = join(link, Side::second);
    first->leave();
    const auto seen = observed(link);
    CHECK(seen.segment.side(Side::first).state == PeerState::dead);
    CHECK(seen.segment.side(Side::first).left);
    CHECK_FALSE(seen.segment.side(Side::first).held);
    CHECK(seen.segment.side(Side::second).held);
    CHECK_FALSE(seen.segment.side(Side::second).left);
}

TEST_CASE("an observer finds the newest or the requested generation") {
    const Link link;
    CHECK_FALSE(observe(link.name));
    auto first = join(link, Side::first);
    const auto generation = first->generation();
    CHECK(observe(link.name, generation)->segment.generation == generation);
    CHECK_FALSE(observe(link.name, generation + 1));
    CHECK_THROWS_AS(observe("no/link"), Error);
}

TEST_CASE("observing changes neither a byte nor a time stamp of the file and wakes no watcher") {
    const Furnished pair;
    struct stat before {
    }, after{};
    const std::string path = pair.first->path(), bytes = content_of(path);
    // Even `relatime` would update an access time that is older than the last change.
    const timespec times[2] = {{1, 0}, {0, UTIME_OMIT}};
    REQUIRE(utimensat(AT_FDCWD, path.c_str(), times, 0) == 0);
    REQUIRE(stat(path.c_str(), &before) == 0);
    Watcher watcher(pair.link.name);
    pair.first->watch(watcher);
    for (int i = 0; i < 10; ++i) {
        observe_segments();
        observed(pair.link);
    }
    REQUIRE(stat(path.c_str(), &after) == 0);
    CHECK(after.st_atim.tv_sec == before.st_atim.tv_sec);
    CHECK(after.st_mtim.tv_sec == before.st_mtim.tv_sec);
    CHECK(after.st_mtim.tv_nsec == before.st_mtim.tv_nsec);
    CHECK(watcher.wait(0ns) == Watcher::Event::none);
    CHECK(content_of(path) == bytes);
}

TEST_CASE("a segment truncated at any place is reported as damaged") {
    const Furnished pair;
    const auto copy = content_of(pair.first->path());
    const auto place = segment_path(pair.link.name, 900);
    for (const std::size_t bytes :
         {std::size_t{0}, std::size_t{1}, std::size_t{88}, layout::page - 1, layout::page, layout::page + 600,
          layout::arenas_begin - 1, layout::arenas_begin, layout::arenas_begin + 100, copy.size() - 1}) {
        std::ofstream(place, std::ios::binary) << copy.substr(0, bytes);
        const auto seen = observe(pair.link.name, 900);
        REQUIRE(seen);
        CHECK(seen->segment.readability == Readability::damaged);
        CHECK_FALSE(seen->segment.reason.empty());
        CHECK(seen->segment.file_bytes == bytes);
        CHECK(seen->segment.memory_bytes == round_up(bytes, layout::page));
        CHECK(seen->rings.empty());
    }
}

TEST_CASE("a segment of another layout version or line size is reported as such") {
    const Furnished pair;
    overwrite(pair.first->path(), offsetof(layout::SegmentHeader, line_bytes), "\x80");
    const auto other_lines = observed(pair.link);
    CHECK(other_lines.segment.readability == Readability::other_layout);
    CHECK(other_lines.segment.reason ==
          "lines and pages of 128 and 4096 bytes, this program reads 64 and 4096");
    overwrite(pair.first->path(), offsetof(layout::SegmentHeader, layout_version), "\x63");
    const auto seen = observed(pair.link);
    CHECK(seen.segment.readability == Readability::other_layout);
    CHECK(seen.segment.reason.find("99") != std::string::npos);
}

TEST_CASE("a file that is not regular is not opened") {
    const Link link;
    const auto path = segment_path(link.name, 1);
    SECTION("a link") { std::filesystem::create_symlink("/etc/passwd", path); }
    SECTION("a pipe") { REQUIRE(mkfifo(path.c_str(), 0600) == 0); }
    SECTION("a folder") { std::filesystem::create_directory(path); }
    const auto seen = observed(link);
    CHECK(seen.segment.readability == Readability::damaged);
    CHECK(seen.segment.reason == "not a regular file");
}

TEST_CASE("a segment of another user is reported and not opened") {
    if (geteuid() != 0) TANDEM_SKIP("only root can make a segment of another user");
    const Furnished pair;
    const auto path = segment_path(pair.link.name, 900);
    std::filesystem::copy_file(pair.first->path(), path);
    REQUIRE(chown(path.c_str(), 12345, 12345) == 0);
    auto seen = observe(pair.link.name, 900);
    REQUIRE(seen);
    CHECK(seen->segment.readability == Readability::foreign);
    CHECK(seen->segment.owner == 12345);
    CHECK(seen->segment.layout_version == 0);
    CHECK(seen->rings.empty());

    // It may be observed if it is shared with a group of this user.
    REQUIRE(chown(path.c_str(), 12345, getegid()) == 0);
    REQUIRE(chmod(path.c_str(), 0660) == 0);
    CHECK(observe(pair.link.name, 900)->segment.layout_version == layout::layout_version);
}

TEST_CASE("a damaged directory costs its damaged entries only") {
    const Furnished pair;
    const std::string path = pair.first->path();
    SECTION("an offset beyond the arena") {
        overwrite(path, directory_of(Side::first) + offsetof(layout::DirectoryEntry, offset),
                  std::string(8, '\xff'));
        const auto seen = observed(pair.link);
        CHECK(seen.damage.size() == 1);
        CHECK(seen.rings.empty());
        CHECK(seen.call_queues.size() == 1);
        CHECK(seen.blobs.size() == 1);
    }
    SECTION("a name without an end") {
        overwrite(path, directory_of(Side::first), std::string(layout::name_bytes, 'x'));
        CHECK(observed(pair.link).damage.size() == 1);
    }
    SECTION("more entries than there is room for") {
        overwrite(path, directory_of(Side::first) - 128, std::string(4, '\xff'));
        const auto seen = observed(pair.link);
        CHECK(seen.damage.size() == 1);
        CHECK(seen.rings.empty());
    }
    SECTION("a ring that claims another size") {
        overwrite(path, layout::arenas_begin, std::string(8, '\x7f'));
        const auto seen = observed(pair.link);
        CHECK_FALSE(seen.rings.at(0).damage.empty());
        CHECK(seen.call_queues.at(0).damage.empty());
    }
}

TEST_CASE("objects that claim the same memory do not multiply the memory of the observer") {
    Pair pair;
    pair.first->add_blob("large", 256 * 1024);
    pair.first->publish();
    const std::string path = pair.first->path(),
                      entry =
                          content_of(path).substr(directory_of(Side::first), sizeof(layout::DirectoryEntry));
    std::string entries, count(4, '\0');
    for (std::size_t i = 0; i < layout::max_objects; ++i) entries += entry;
    count[0] = 1, count[1] = 2; // 1 + 512
    overwrite(path, directory_of(Side::first), entries);
    overwrite(path, directory_of(Side::first) - 128, count);
    const auto seen = observed(pair.link);
    REQUIRE(seen.blobs.size() == layout::max_objects);
    std::uint64_t copied = 0;
    for (const auto& blob : seen.blobs) copied += blob.content.size();
    CHECK(copied <= seen.segment.memory_bytes);
    CHECK_FALSE(seen.blobs.back().damage.empty());
}

TEST_CASE("the observer answers whatever the bytes of the headers are") {
    const Furnished pair;
    const std::string path = pair.first->path(), sound = content_of(path);
    const std::size_t objects_end =
        layout::arenas_begin + sizeof(layout::RingHeader) + pair.ring.view.capacity + 1024;
    std::size_t looks = 0;
    const auto check = [&](std::size_t from, std::size_t to) {
        for (std::size_t at = from; at < to; ++at)
            for (const char value : {'\0', '\x01', '\x7f', '\x80', '\xff'}) {
                overwrite(path, at, std::string(1, value));
                REQUIRE(observe(pair.link.name));
                ++looks;
                overwrite(path, at, sound.substr(at, 1));
            }
    };
    check(0, 96);
    check(layout::page, layout::page + 512);
    check(directory_of(Side::first), directory_of(Side::first) + 3 * sizeof(layout::DirectoryEntry));
    check(layout::arenas_begin, layout::arenas_begin + sizeof(layout::RingHeader));
    check(objects_end - 1024, objects_end);
    CHECK(observed(pair.link).damage.empty());
    CHECK(looks > 1000);
}

TEST_CASE("a segment that shrinks and grows under the observer never ends it") {
    const Furnished pair;
    const auto path = segment_path(pair.link.name, 900);
    const auto sound = content_of(pair.first->path());
    std::ofstream(path, std::ios::binary) << sound;
    std::atomic<bool> stop = false;
    std::atomic<int> failures = 0;
    std::thread other([&] { // Catch2 counts in one thread only
        for (std::size_t i = 0; !stop; ++i) {
            failures += truncate(path.c_str(), static_cast<off_t>((i * 7919) % sound.size())) != 0;
            failures += truncate(path.c_str(), static_cast<off_t>(sound.size())) != 0;
            overwrite(path, 0, sound.substr(0, layout::arenas_begin + 4096));
        }
    });
    std::size_t readable = 0, damaged = 0;
    for (std::size_t i = 0; i < stress(2000); ++i) {
        const auto seen = observe(pair.link.name, 900);
        REQUIRE(seen);
        ++(seen->segment.readability == Readability::readable ? readable : damaged);
    }
    stop = true;
    other.join();
    CHECK(failures == 0);
    CHECK(readable + damaged == stress(2000));
}

TEST_CASE("counters read while both ends run are always plausible") {
    Pair pair;
    const auto ring = pair.first->add_ring("data", {.max_record = 64, .capacity = 1024});
    pair.first->publish();
    std::atomic<bool> stop = false;
    std::thread writing([&] {
        RingWriter writer(ring);
        while (!stop) writer.write(bytes_of("some payload"), 0);
    });
    std::thread reading([&] {
        RingReader reader(*pair.second->find_ring(Side::first, "data"));
        while (!stop) reader.read();
    });
    std::uint64_t sent = 0, received = 0;
    bool sound = true;
    for (std::size_t i = 0; i < stress(3000); ++i) {
        const auto seen = observed(pair.link);
        const auto& c = seen.rings.at(0).counters;
        sound = sound && seen.rings[0].damage.empty() && c.sent >= sent && c.received >= received &&
                c.sent >= c.received; // the two are read one after the other: waiting() has no bound here
        sent = c.sent;
        received = c.received;
    }
    stop = true;
    writing.join();
    reading.join();
    CHECK(sound);
    const auto seen = observed(pair.link);
    const auto& c = seen.rings.at(0).counters;
    CHECK(c.sent == c.received + c.dropped() + c.waiting());
}

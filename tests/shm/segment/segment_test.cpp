// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_client.hpp"
#include "shm/os/link_name.hpp"
#include "shm/segment/process_identity.hpp"
#include "tests/shm/fixture.hpp"
#include "tests/support/own_namespaces.hpp"
#include "tests/support/skip.hpp"

#include <fcntl.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/syscall.h>

using namespace tandem::shm;
using namespace tandem::shm::test;
using Catch::Contains;

TEST_CASE("the first to join creates a file of mode 0600 and the last to leave removes it") {
    Link link;
    auto first = join(link, Side::first);
    REQUIRE(link.files().size() == 1);
    struct stat file {};
    REQUIRE(stat(first->path().c_str(), &file) == 0);
    CHECK((file.st_mode & 07777) == 0600);
    CHECK(file.st_blocks * 512 >= file.st_size); // reserved in full
    auto second = join(link, Side::second);
    CHECK(second->generation() == first->generation());
    first.reset();
    CHECK(link.files().size() == 1);
    second.reset();
    CHECK(link.files().empty());
}

TEST_CASE("each side sees the other absent then alive then dead") {
    Link link;
    auto first = join(link, Side::first);
    CHECK(first->peer_state() == PeerState::absent);
    auto second = join(link, Side::second);
    CHECK(first->peer_state() == PeerState::alive);
    second.reset();
    CHECK(first->peer_state() == PeerState::dead);
}

TEST_CASE("a side that a living process holds is refused") {
    Pair pair;
    CHECK_THROWS_AS(join(pair.link, Side::first), SideTaken);
    CHECK_THROWS_WITH(join(pair.link, Side::second), Contains("side second is held by a living process"));
    CHECK(pair.link.files().size() == 1);
}

TEST_CASE("any text is converted to a valid name of a link, and a valid one is unchanged") {
    for (const std::string text : {"", "-v", "a/b c", "\xc3\xa4", ".."}) {
        CAPTURE(text);
        CHECK_FALSE(is_link_name(text));
        CHECK(is_link_name(as_link_name(text)));
    }
    CHECK(as_link_name("-v/b") == "_v_b");
    CHECK(as_link_name(std::string(65, 'a')) == std::string(64, 'a'));
    CHECK(as_link_name("a-b_C9") == "a-b_C9");
}

TEST_CASE("link names that could not be file names or could be options are refused") {
    for (const auto* name : {"", "a/b", "..", "a.1", "a b", "\n", "-a"})
        CHECK_THROWS_AS(Segment::join(name, Side::first), Error);
    CHECK_THROWS_AS(Segment::join(std::string(65, 'x'), Side::first), Error);
    CHECK_THROWS_AS(remove_dead("../x"), Error);
}

TEST_CASE("too little room in /dev/shm is an error that names needed and available bytes") {
    Link link;
    auto options = small(std::size_t{1} << 45);
    CHECK_THROWS_WITH(join(link, Side::first, options),
                      Contains("bytes needed") && Contains("available in /dev/shm"));
    CHECK(link.files().empty());
}

TEST_CASE("another contract version is refused with both versions in the message") {
    Link link;
    auto options = small();
    options.contract = 7;
    auto first = join(link, Side::first, options);
    options.contract = 8;
    CHECK_THROWS_WITH(join(link, Side::second, options), Contains("version 7") && Contains("has 8"));
}

TEST_CASE("another layout version is refused with both versions in the message") {
    Link link;
    auto first = join(link, Side::first);
    const std::uint32_t version = layout::layout_version + 41;
    const FileDescriptor file(open(first->path().c_str(), O_RDWR | O_CLOEXEC));
    REQUIRE(pwrite(file.get(), &version, sizeof version, offsetof(layout::SegmentHeader, layout_version)) ==
            4);
    CHECK_THROWS_WITH(join(link, Side::second),
                      Contains("layout version " + std::to_string(version)) &&
                          Contains("has " + std::to_string(layout::layout_version)));
}

TEST_CASE("a segment of another build's units or byte order is refused in one line") {
    Link link;
    auto first = join(link, Side::first);
    const FileDescriptor file(open(first->path().c_str(), O_RDWR | O_CLOEXEC));
    const auto refused_after = [&](std::size_t offset, auto value, const std::string& message) {
        REQUIRE(pwrite(file.get(), &value, sizeof value, static_cast<off_t>(offset)) == sizeof value);
        CHECK_THROWS_WITH(join(link, Side::second),
                          Contains(message) && Contains("use one build") && !Contains("\n"));
    };
    refused_after(offsetof(layout::SegmentHeader, line_bytes), std::uint32_t{128},
                  "has lines and pages of 128 and 4096 bytes, this process has 64 and 4096");
    refused_after(offsetof(layout::SegmentHeader, page_bytes), std::uint32_t{65536},
                  "has lines and pages of 128 and 65536 bytes");
    refused_after(offsetof(layout::SegmentHeader, magic), __builtin_bswap64(layout::magic),
                  "has the byte order of another processor");
}

TEST_CASE("a segment of another mode is refused while a side lives in it") {
    Link link;
    auto first = join(link, Side::first);
    REQUIRE(chmod(first->path().c_str(), 0666) == 0);
    CHECK_THROWS_WITH(join(link, Side::second),
                      Contains("mode 0666") && Contains("expected") && Contains("0600"));
}

TEST_CASE("a named group gets mode 0660 and an unknown group is refused") {
    Link link;
    auto options = small();
    options.group = "no-such-group-here";
    CHECK_THROWS_WITH(join(link, Side::first, options), Contains("no-such-group-here"));
    if (geteuid() != 0) TANDEM_SKIP("only root may name a group that it is not a member of");
    options.group = "daemon";
    auto first = join(link, Side::first, options);
    struct stat file {};
    REQUIRE(stat(first->path().c_str(), &file) == 0);
    CHECK((file.st_mode & 07777) == 0660);
    CHECK(join(link, Side::second, options)->generation() == first->generation());
}

TEST_CASE("a group that this process is not in is refused and nothing is left behind") {
    Link link;
    Child outsider([&] {
        if (geteuid() == 0 && (setgroups(0, nullptr) != 0 || setgid(65534) != 0 || setuid(65534) != 0))
            return 1;
        JoinOptions options = small();
        options.group = "root";
        try {
            join(link, Side::first, options);
        } catch (const Error& refused) {
            return std::string(refused.what()).find("cannot be given to group 0 (") != std::string::npos ? 42
                                                                                                         : 2;
        }
        return 3;
    });
    CHECK(outsider.wait() == 42);
    CHECK(link.files().empty());
}

TEST_CASE("a segment larger than the address space is refused in one line and nothing is left behind") {
    Link link;
    JoinOptions options = small();
    options.sparse = true; // so that it is not the memory which is missing
    options.chunk_pool_bytes = std::size_t{1} << 50;
    CHECK_THROWS_WITH(join(link, Side::first, options),
                      Contains(link.name) && Contains("bytes cannot be mapped"));
    CHECK(link.files().empty());
}

TEST_CASE("a symbolic link or a directory under a segment name is refused") {
    Link link;
    const std::string path = segment_path(link.name, 1);
    REQUIRE(symlink("/etc/passwd", path.c_str()) == 0);
    CHECK_THROWS_AS(join(link, Side::first), Error);
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    CHECK_THROWS_AS(join(link, Side::first), Error);
}

TEST_CASE("garbage under a segment name is removed when no side lives in it") {
    Link link;
    const FileDescriptor file(open(segment_path(link.name, 4).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
    auto first = join(link, Side::first);
    CHECK(link.files().size() == 1);
    CHECK(link.files()[0] == first->path());
}

TEST_CASE("a side that has left can be taken again while old objects still use the memory") {
    Pair pair;
    RingWriter writer(pair.first->add_ring("r", {}));
    pair.first->leave();
    CHECK(pair.second->peer_state() == PeerState::dead);
    auto again = join(pair.link, Side::first);
    CHECK(again->generation() == pair.second->generation() + 1);
    CHECK(writer.write(bytes_of("into the void"), 0));
    pair.first->leave();
    pair.second->leave();
    CHECK(pair.link.files().size() == 1);
}

TEST_CASE("a fork()ed child that destroys its copy of a segment does not end its parent's life") {
    Pair pair;
    Child child([&] {
        pair.first.reset();
        return 0;
    });
    CHECK(child.wait() == 0);
    CHECK(pair.second->peer_state() != PeerState::dead);
}

namespace {

/// A child process that goes on when its parent has ended, until its input ends. A child of clone(2) runs no handlers of
/// pthread_atfork(), so it keeps all descriptors.
void start_helper_that_reads(bool by_clone, int input, int report) {
    const auto helper = by_clone ? static_cast<pid_t>(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0)) : fork();
    if (helper != 0) {
        [[maybe_unused]] const auto told = write(report, &helper, sizeof helper);
        return;
    }
    char byte;
    while (read(input, &byte, 1) > 0) {
    }
    _exit(0);
}

} // namespace

TEST_CASE("a killed process does not live on in a helper that it has started by fork() or clone()") {
    const bool by_clone = GENERATE(false, true);
    CAPTURE(by_clone);
    Link link;
    int keep_alive[2], report[2];
    REQUIRE(pipe2(keep_alive, O_CLOEXEC) == 0);
    REQUIRE(pipe2(report, O_CLOEXEC) == 0);
    auto second = join(link, Side::second);
    CallClient client(second->add_call_queue("c", {.callers = Side::second, .slots = 1, .max_bytes = 8}));
    second->publish();
    Child host([&] {
        const auto first = join(link, Side::first);
        close(keep_alive[1]);
        start_helper_that_reads(by_clone, keep_alive[0], report[1]);
        for (;;) pause();
        return 0;
    });
    pid_t helper = 0;
    REQUIRE(read(report[0], &helper, sizeof helper) == sizeof helper);
    REQUIRE(second->peer_state() == PeerState::alive);
    Watcher watcher(link.name);
    second->watch(watcher);
    REQUIRE_FALSE(watcher.watch_process(second->peer_process().pid));
    const auto left_behind = second->generation();
    host.kill_now();
    CHECK(::kill(helper, 0) == 0);
    CHECK(watcher.wait(20s) == Watcher::Event::departed);
    CHECK(eventually([&] { return second->peer_state() == PeerState::dead; }));
    CHECK(client.call({}, 60s).status == CallStatus::peer_died);
    std::unique_ptr<Segment> again;
    CHECK_NOTHROW(again = join(link, Side::first));
    if (again) CHECK(again->generation() == left_behind + 1);
    CHECK_FALSE(probe_segment(segment_path(link.name, left_behind)).held[index_of(Side::first)]);
    CHECK(::kill(helper, 0) == 0);
    close(keep_alive[1]); // ends the helper
}

TEST_CASE("a side in another pid namespace is alive until it ends, whatever process has its pid here") {
    Link link;
    int keep_alive[2];
    REQUIRE(pipe2(keep_alive, O_CLOEXEC) == 0);
    auto first = join(link, Side::first);
    Child outside([&] {
        if (!tandem::test::enter_own_namespaces(CLONE_NEWPID)) return 42;
        Child inside([&] { // its pid is 1 there
            const auto second = join(link, Side::second);
            close(keep_alive[1]);
            char byte;
            while (read(keep_alive[0], &byte, 1) > 0) {
            }
            return 0;
        });
        close(keep_alive[1]);
        return inside.wait();
    });
    std::optional<int> code;
    REQUIRE(eventually([&] { return (code = outside.ended()) || first->peer_state() != PeerState::absent; }));
    if (code == 42) TANDEM_SKIP("this process may not make a namespace of processes");
    REQUIRE_FALSE(code);
    CHECK(first->peer_process().pid == 1);
    CHECK(find_process(first->peer_process()) == ProcessLookup::elsewhere);
    CHECK(first->peer_state() == PeerState::alive);
    CHECK_THROWS_AS(join(link, Side::second), SideTaken);
    close(keep_alive[1]);
    CHECK(eventually([&] { return first->peer_state() == PeerState::dead; }));
    CHECK(outside.wait() == 0);
}

TEST_CASE("a process is identified by more than its pid") {
    ProcessIdentity self = identify_this_process();
    CHECK(find_process(self) == ProcessLookup::running);
    ProcessIdentity before = self; // an earlier process with the same pid
    before.start_ticks -= 1;
    CHECK(find_process(before) == ProcessLookup::ended);
    before.time_namespace += 1; // where start times are others
    CHECK(find_process(before) == ProcessLookup::running);
    self.pid_namespace += 1;
    CHECK(find_process(self) == ProcessLookup::elsewhere);
    CHECK(find_process(ProcessIdentity{}) == ProcessLookup::elsewhere);
}

TEST_CASE("a process that waits to be reaped has ended") {
    Link link;
    auto first = join(link, Side::first);
    Child child([&] {
        const auto second = join(link, Side::second);
        return 0;
    });
    REQUIRE(eventually([&] { return first->peer_state() == PeerState::dead; }));
    const ProcessIdentity process = first->peer_process();
    CHECK(eventually([&] { return find_process(process) == ProcessLookup::ended; }));
    CHECK(child.wait() == 0);
}

TEST_CASE("two sides in one process both stay alive when the process forks") {
    Pair pair;
    Child child([&] {
        const bool alive = pair.first->peer_state() == PeerState::alive;
        return alive && join(pair.link, Side::first) ? 0 : 1; // refused: both are its parent's
    });
    CHECK(child.wait() == 99);
    CHECK(pair.first->peer_state() == PeerState::alive);
    CHECK(pair.second->peer_state() == PeerState::alive);
}

// SPDX-License-Identifier: Apache-2.0
// After the first messages: no allocation, and no system call while the reader is awake. This program replaces operator
// new to count, and lets the kernel kill a child for any system call.
#include "fixture.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/inspect/ring_follower.hpp"

#include <csignal>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <new>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace {
std::atomic<std::size_t> allocations{0};
} // namespace

// Not inlined: GCC then takes malloc() and operator delete for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
    ++allocations;
    if (void* memory = std::malloc(bytes)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(bytes);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

constexpr char text[] = "some bytes to carry";

void one_message(RingWriter& writer, RingReader& reader, Doorbell& bell, Doorbell& mine) {
    const auto room = writer.reserve(sizeof text);
    std::memcpy(room.data(), text, sizeof text);
    writer.commit(sizeof text, 1);
    bell.ring(3);
    mine.poll();
    reader.read();
}

} // namespace

TEST_CASE("rings and doorbells do not allocate") {
    Pair pair;
    RingWriter writer(pair.first->add_ring("r", {.max_record = 100, .capacity = 512}));
    pair.first->publish();
    RingReader reader(*pair.second->find_ring(Side::first, "r"));
    const std::size_t before = allocations;
    for (int i = 0; i < 10000; ++i)
        one_message(writer, reader, pair.first->peer_doorbell(), pair.second->doorbell());
    for (int i = 0; i < 100; ++i) {
        pair.first->peer_state();
        pair.first->superseded();
    }
    const std::size_t after = allocations;
    CHECK(after == before);
    CHECK(reader.counters().received == 10000);
}

TEST_CASE("calls do not allocate once their buffers are large enough") {
    Pair pair;
    CallClient client(pair.first->add_call_queue("c", {.slots = 2, .max_bytes = 256}));
    pair.first->publish();
    CallServer server(*pair.second->find_call_queue(Side::first, "c"));
    std::thread worker([&] {
        while (auto call = server.take(20s)) call->reply(CallStatus::ok, call->arguments());
    });
    std::vector<std::byte> results;
    std::size_t before = 0, wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        if (i == 100) before = allocations;
        if (client.call_into(std::as_bytes(std::span(text)), 20s, results) != CallStatus::ok) ++wrong;
    }
    const std::size_t after = allocations;
    server.end_all_waits();
    worker.join();
    CHECK(wrong == 0);
    CHECK(after == before);
}

#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
std::atomic<std::size_t> looks{0}; ///< system calls that count_looks() counts

/// From here on, does not execute system calls of this thread other than those of a sleep and of a test of a lock, but counts
/// them.
void count_looks() {
    struct sigaction count {};
    count.sa_handler = [](int) { ++looks; };
    sigaction(SIGSYS, &count, nullptr);
    sock_filter rules[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 4, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 3, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_futex, 2, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_fcntl, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    sock_fprog program{std::size(rules), rules};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        _exit(98);
}

TEST_CASE("a call that sleeps until its reply neither looks for the process of the peer nor allocates") {
    constexpr std::size_t calls = 100;
    Pair pair;
    const WaitOptions how{.mode = WaitMode::futex};
    const auto queue = pair.first->add_call_queue("c", {.slots = 4, .max_bytes = 256});
    pair.first->publish();
    Child child([&] {
        CallClient client(queue, how);
        CallServer server(*pair.second->find_call_queue(Side::first, "c"), how);
        std::thread worker([&] {
            while (auto call = server.take(300s)) {
                std::this_thread::sleep_for(1ms); // the caller sleeps meanwhile
                call->reply(CallStatus::ok, call->arguments());
            }
        });
        std::vector<std::byte> results(sizeof text);
        for (int i = 0; i < 10; ++i) client.call_into(std::as_bytes(std::span(text)), 300s, results);
        const std::size_t before = allocations;
        count_looks();
        for (std::size_t i = 0; i < calls; ++i)
            if (client.call_into(std::as_bytes(std::span(text)), 300s, results) != CallStatus::ok) _exit(1);
        if (allocations != before) _exit(2);
        _exit(looks < calls / 2 ? 42 : 3); // a call that takes more than 100 ms on a busy machine may look
        return 0;
    });
    CHECK(child.wait() == 42);
}

/// From here on the kernel ends this process if this thread makes any system call but exit_group. (A filter,
/// because strict mode also forbids the time-stamp counter, which the clock reads without a system call.)
void forbid_system_calls() {
    sock_filter rules[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
    };
    sock_fprog program{std::size(rules), rules};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        _exit(98);
}

TEST_CASE("the data path makes no system call while the reader is awake") {
    Pair pair;
    Child child([&] {
        RingWriter writer(pair.first->add_ring("r", {.max_record = 100, .capacity = 512}));
        pair.first->publish();
        RingReader reader(*pair.second->find_ring(Side::first, "r"));
        pair.second->doorbell().poll();
        forbid_system_calls();
        for (int i = 0; i < 10000; ++i)
            one_message(writer, reader, pair.first->peer_doorbell(), pair.second->doorbell());
        for (int i = 0; i < 3; ++i) writer.write(std::as_bytes(std::span(text)), 0);
        reader.read_newest();
        _exit(42); // counting what was covered would need system calls
        return 0;
    });
    CHECK(child.wait() == 42);
}

TEST_CASE("an observer costs the data path neither a system call nor an allocation") {
    Pair pair;
    RingWriter writer(pair.first->add_ring("r", {.max_record = 100, .capacity = 4096}));
    pair.first->publish();
    RingReader reader(*pair.second->find_ring(Side::first, "r"));
    void* const memory =
        mmap(nullptr, sizeof(std::atomic<bool>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    auto* const watched = new (memory) std::atomic<bool>(false);
    Child hosts([&] {
        pair.second->doorbell().poll();
        const std::size_t before = allocations;
        forbid_system_calls();
        for (const auto deadline = deadline_after(300s); !*watched && now_ns() < deadline;)
            one_message(writer, reader, pair.first->peer_doorbell(), pair.second->doorbell());
        _exit(!*watched ? 1 : allocations == before ? 42 : 3);
        return 0;
    });
    // The work of the monitor and the recorder: reads the counters, and copies messages beside the reader.
    const auto seen = observe(pair.link.name);
    REQUIRE(seen);
    RingFollower follower(std::make_shared<const ReadOnlySnapshot>(seen->segment.path), seen->rings.at(0));
    std::uint64_t looks = 0;
    CHECK(eventually(
        [&] {
            follower.poll([](const FollowedRecord&) {});
            return observe(pair.link.name)->rings.at(0).counters.sent > 10'000 && ++looks > 100 &&
                   follower.delivered() > 1000;
        },
        200s));
    *watched = true;
    CHECK(hosts.wait() == 42);
    munmap(memory, sizeof(std::atomic<bool>));
}

TEST_CASE("messages in chunks allocate nothing, and make no system call once each chunk was used") {
    constexpr std::size_t large = 100'000;
    constexpr std::uint32_t chunks = 4;
    JoinOptions options = small();
    options.sparse = true;
    Link link;
    options.chunk_pool_bytes = chunks * large * 2;
    Child child([&] {
        const auto first = join(link, Side::first, options);
        RingWriter writer(first->add_ring(
            "r", {.max_record = 100, .capacity = 512, .chunk_bytes = large, .chunks = chunks}));
        first->publish();
        const auto peer = join(link, Side::second, small());
        RingReader reader(*peer->find_ring(Side::first, "r"));
        const std::size_t before = allocations;
        for (std::uint64_t i = 0; i < 10'000; ++i) {
            if (i == chunks) forbid_system_calls();
            const auto room = writer.reserve(large);
            if (room.data() == nullptr) _exit(1);
            std::memcpy(room.data(), &i, sizeof i);
            writer.commit(large, i);
            const auto record = reader.read();
            if (!record || std::memcmp(record->bytes.data(), &i, sizeof i) != 0) _exit(2);
        }
        _exit(allocations == before ? 42 : 3); // what is still open would need system calls
        return 0;
    });
    CHECK(child.wait() == 42);
}

TEST_CASE("calls make no system call while both sides poll") {
    Pair pair;
    const WaitOptions how{.mode = WaitMode::spin_then_futex, .spin = 300s};
    const auto queue = pair.first->add_call_queue("c", {.slots = 4, .max_bytes = 256});
    pair.first->publish();
    Child child([&] {
        CallClient client(queue, how);
        CallServer server(*pair.second->find_call_queue(Side::first, "c"), how);
        std::thread worker([&] {
            forbid_system_calls();
            while (auto call = server.take(300s)) call->reply(CallStatus::ok, call->arguments());
        });
        std::vector<std::byte> results(sizeof text);
        client.call_into(std::as_bytes(std::span(text)), 300s, results);
        forbid_system_calls();
        for (int i = 0; i < 10000; ++i) {
            const auto status = client.call_into(std::as_bytes(std::span(text)), 300s, results);
            if (status != CallStatus::ok || results.size() != sizeof text) _exit(1);
        }
        _exit(42); // the worker polls on until then
        return 0;
    });
    CHECK(child.wait() == 42);
}
#endif

// SPDX-License-Identifier: Apache-2.0
// After warm-up: no allocation, and no system call while the reader is awake. This program replaces operator
// new to count, and lets the kernel kill a child for any system call.
#include "fixture.hpp"

#include "shm/call_client.hpp"
#include "shm/call_server.hpp"

#include <linux/seccomp.h>
#include <new>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace {
std::atomic<std::size_t> allocations{0};
} // namespace

void* operator new(std::size_t bytes) {
    ++allocations;
    if (void* memory = std::malloc(bytes)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

constexpr auto all_policies = {RingPolicy::latest_only, RingPolicy::drop_oldest, RingPolicy::reject,
                               RingPolicy::wait};
constexpr char text[] = "some bytes to carry";

void one_message(RingWriter& writer, RingReader& reader, Doorbell& bell, Doorbell& mine) {
    const auto room = writer.reserve(sizeof text);
    std::memcpy(room.data(), text, sizeof text);
    writer.commit(sizeof text, 1, 2);
    bell.ring(3);
    mine.poll();
    reader.read();
}

} // namespace

TEST_CASE("rings and doorbells do not allocate") {
    for (const auto policy : all_policies) {
        Pair pair;
        RingWriter writer(pair.first->add_ring("r", {.policy = policy, .max_record = 100, .capacity = 512}));
        pair.first->publish();
        RingReader reader(*pair.second->find_ring(Side::first, "r"));
        const std::size_t before = allocations;
        for (int i = 0; i < 10000; ++i)
            one_message(writer, reader, pair.first->peer_doorbell(), pair.second->doorbell());
        for (int i = 0; i < 100; ++i) pair.first->heartbeat(), pair.first->peer(), pair.first->superseded();
        const std::size_t after = allocations;
        CHECK(after == before);
        CHECK(reader.counters().received == 10000);
    }
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
        if (client.call_into(1, std::as_bytes(std::span(text)), 20s, results) != CallStatus::ok) ++wrong;
    }
    const std::size_t after = allocations;
    server.interrupt();
    worker.join();
    CHECK(wrong == 0);
    CHECK(after == before);
}

#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
TEST_CASE("the data path makes no system call while the reader is awake") {
    for (const auto policy : all_policies) {
        Pair pair;
        Child child([&] {
            RingWriter writer(
                pair.first->add_ring("r", {.policy = policy, .max_record = 100, .capacity = 512}));
            pair.first->publish();
            RingReader reader(*pair.second->find_ring(Side::first, "r"));
            pair.second->doorbell().poll();
            // From here on the kernel kills this process for anything but read, write and exit.
            prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT);
            for (int i = 0; i < 10000; ++i)
                one_message(writer, reader, pair.first->peer_doorbell(), pair.second->doorbell());
            for (int i = 0; i < 3; ++i) writer.write(std::as_bytes(std::span(text)), 0, 0);
            reader.read_newest();
            syscall(SYS_exit, 42);
            return 0;
        });
        CHECK(child.wait() == 42);
    }
}
#endif

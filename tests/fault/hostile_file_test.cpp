// SPDX-License-Identifier: Apache-2.0
// A segment's file that is cut short, before it is joined and while it is in use.
#include "../shm/fixture.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/inspect/observer.hpp"
#include "shm/segment/truncation_guard.hpp"

#include <fcntl.h>
#include <sys/mman.h>

using namespace tandem::shm;
using namespace tandem::shm::test;
using Catch::Contains;

namespace {

constexpr std::size_t file_arena = 64 * 1024;
constexpr off_t whole_file = layout::arenas_begin + 2 * file_arena;

RingOptions with_chunks(Side writer) {
    return {.writer = writer, .max_record = 200, .capacity = 8192, .chunk_bytes = 8192, .chunks = 2};
}

/// Performs all operations of a side on the objects that it had found. None of them may end the process.
void use_all(Segment& mine, RingWriter& writer, RingReader& reader, CallClient& client, CallServer& server) {
    for (int i = 0; i < 100; ++i) {
        mine.peer_state();
        mine.doorbell().poll();
        mine.ring_peer(1);
        writer.write(bytes_of(std::string(static_cast<std::size_t>(i * 90), 'x')), 1);
        reader.read();
        reader.read_newest();
        client.call(bytes_of("x"), 10us);
        if (auto call = server.take(0ns)) call->reply(CallStatus::ok);
    }
    try {
        mine.list(Side::first);
        mine.find_ring(Side::second, "to-first");
    } catch (const Error&) {
    }
}

} // namespace

TEST_CASE("a file that is shorter than its header says is refused, and an observer reports it as damaged") {
    for (const off_t bytes : {off_t{0}, off_t{1}, off_t{87}, off_t{4095}, off_t{4096}, off_t{5000},
                              off_t{layout::arenas_begin}, whole_file - 4096, whole_file - 1}) {
        Link link;
        auto first = join(link, Side::first, small(file_arena));
        REQUIRE(truncate(first->path().c_str(), bytes) == 0);
        CAPTURE(bytes);
        try {
            join(link, Side::second, small(file_arena));
            FAIL_CHECK("it was joined");
        } catch (const Error& refused) {
            CHECK_THAT(refused.what(), Contains(first->path()));
            CHECK(std::string(refused.what()).find('\n') == std::string::npos);
        }
        const auto observed = observe(link.name);
        REQUIRE(observed);
        CHECK(observed->segment.readability == Readability::damaged);
        CHECK(first->superseded());
        // Leaving touches the peer's half; without the guard, this would end the process.
        REQUIRE(truncate(first->path().c_str(), whole_file) == 0);
        first.reset();
        CHECK(link.files().empty());
    }
}

TEST_CASE("a file that grows is used as before, because long calls are stored after the segment") {
    Link link;
    auto first = join(link, Side::first, small(file_arena));
    REQUIRE(truncate(first->path().c_str(), whole_file + 4096) == 0);
    auto second = join(link, Side::second, small(file_arena));
    CHECK(second->path() == first->path());
    CHECK_FALSE(first->superseded());
}

TEST_CASE("with the guard, a file that is truncated in use ends no process, and superseded() returns true") {
    for (const off_t bytes : {off_t{0}, off_t{4096}, off_t{8192}, off_t{layout::arenas_begin},
                              off_t{layout::arenas_begin + 8192}}) {
        Link link;
        Child cut([&] {
            install_truncation_guard();
            install_truncation_guard(); // once is enough
            auto first = join(link, Side::first, small(file_arena));
            auto second = join(link, Side::second, small(file_arena));
            RingReader reader(first->add_ring("to-first", with_chunks(Side::second)));
            RingWriter writer(first->add_ring("to-second", with_chunks(Side::first)));
            CallClient client(first->add_call_queue("c", {.slots = 2, .max_bytes = 64}));
            first->publish();
            CallServer server(*second->find_call_queue(Side::first, "c"));
            use_all(*first, writer, reader, client, server);
            if (first->superseded()) return 1;
            if (truncate(first->path().c_str(), bytes) != 0) return 2;
            if (!first->superseded() || !second->superseded()) return 3;
            use_all(*first, writer, reader, client, server);
            first.reset();
            second.reset();
            if (!link.files().empty()) return 4;
            // The damage does not affect the next generation.
            first = join(link, Side::first, small(file_arena));
            second = join(link, Side::second, small(file_arena));
            return first->peer_state() == PeerState::alive ? 0 : 5;
        });
        CAPTURE(bytes);
        CHECK(cut.wait() == 0);
        CHECK(link.files().empty());
    }
}

namespace {

/// Touches a mapping of a file that ends before it; no segment's.
void touch_lost_memory() {
    FILE* file = std::tmpfile();
    auto* lost = static_cast<volatile char*>(mmap(nullptr, 1, PROT_READ, MAP_SHARED, fileno(file), 0));
    static_cast<void>(lost[0]);
}

} // namespace

TEST_CASE("what was stored into a lost page stays there when a page before it is lost") {
    Link link;
    Child child([&] {
        install_truncation_guard();
        auto first = join(link, Side::first, small(file_arena));
        // Volatile, so that the compiler really reads the memory.
        volatile std::byte* const blob = first->add_blob("pages", 4 * layout::page).data();
        if (truncate(first->path().c_str(), 0) != 0) return 2;
        blob[3 * layout::page] = std::byte{7};
        blob[layout::page] = std::byte{8};
        blob[0] = std::byte{9};
        return blob[3 * layout::page] == std::byte{7} && blob[layout::page] == std::byte{8} ? 0 : 1;
    });
    CHECK(child.wait() == 0);
}

TEST_CASE("the guard leaves what is not a segment to the handler before it or to the system") {
    Child one([] {
        struct sigaction mine {};
        mine.sa_handler = [](int) { _exit(42); };
        sigaction(SIGBUS, &mine, nullptr);
        install_truncation_guard();
        touch_lost_memory();
        return 1;
    });
    CHECK(one.wait() == 42);
    Child two([] {
        struct sigaction mine {};
        mine.sa_sigaction = [](int, siginfo_t* info, void*) { _exit(info->si_code == BUS_ADRERR ? 43 : 1); };
        mine.sa_flags = SA_SIGINFO;
        sigaction(SIGBUS, &mine, nullptr);
        install_truncation_guard();
        touch_lost_memory();
        return 1;
    });
    CHECK(two.wait() == 43);
    Child between([] { // a handler that was installed later and calls ours; ours must not call it back
        install_truncation_guard();
        static struct sigaction guard {};
        struct sigaction mine {};
        mine.sa_sigaction = [](int signal, siginfo_t* info, void* context) {
            static int times = 0;
            if (++times > 3) _exit(44);
            guard.sa_sigaction(signal, info, context);
        };
        mine.sa_flags = SA_SIGINFO;
        sigaction(SIGBUS, &mine, &guard);
        install_truncation_guard();
        touch_lost_memory();
        return 1;
    });
    CHECK(between.wait() == Child::crashed);
    Child three([] {
        signal(SIGBUS, SIG_DFL);
        install_truncation_guard();
        touch_lost_memory();
        return 0;
    });
    CHECK(three.wait() == Child::crashed);
}

// SPDX-License-Identifier: Apache-2.0
// The other side writes whatever it likes. Overwrites every byte of every header with several values, before and after the
// object is opened. Each operation must end in bounded time with an Error or a result within bounds.
#include "fixture.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"

#include <numeric>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// Six that matter; in the long run all 256.
const std::vector<unsigned> values = [] {
    if (stress(1) < 100) return std::vector<unsigned>{0x00, 0x01, 0x08, 0x7f, 0x80, 0xff};
    std::vector<unsigned> all(256);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}();

/// Runs the attempt once for each value of each of the bytes; an Error is a clean end, nothing else is.
void overwrite_each(std::byte* memory, std::size_t from, std::size_t to,
                    const std::function<void()>& attempt) {
    for (std::size_t at = from; at < to; ++at) {
        for (const unsigned value : values) {
            memory[at] = static_cast<std::byte>(value);
            try {
                attempt();
            } catch (const Error&) {
            }
        }
    }
}

std::byte* memory_of(const Segment& segment, Side half, const std::string& name) {
    for (const auto& object : segment.list(half))
        if (object.name == name) return object.memory.data();
    return nullptr;
}

/// Every operation of a reader and a writer of a ring, a few times.
void use(RingReader& reader) {
    for (int i = 0; i < 20; ++i) {
        const auto record = i % 3 == 2 ? reader.read_newest() : reader.read();
        if (record && record->bytes.size() > 100) FAIL("a record of " << record->bytes.size() << " bytes");
    }
    reader.empty();
    reader.counters();
}

void use(RingWriter& writer) {
    for (int i = 0; i < 20; ++i) writer.write(bytes_of(std::string(static_cast<std::size_t>(5 * i), 'x')), 0);
}

RingOptions tiny(Side writer = Side::first) { return {.writer = writer, .max_record = 100, .capacity = 512}; }

} // namespace

TEST_CASE("a damaged segment header ends in an error or in a sound segment") {
    for (std::size_t at = 0; at < 88; ++at) {
        for (const unsigned value : values) {
            Link link;
            auto first = join(link, Side::first, small(4096));
            first->add_blob("b", 100);
            first->publish();
            // The header is the page before the side headers; a hostile peer reaches it through its own mapping.
            const FileDescriptor file = open_segment(first->path(), access_of_this_process(""));
            REQUIRE(pwrite(file.get(), &value, 1, static_cast<off_t>(at)) == 1);
            try {
                auto second = join(link, Side::second, small(4096));
                second->peer_state();
                second->superseded();
                second->add_blob("b", 4096);
                for (const auto& object : second->list(Side::first)) CHECK(object.memory.size() <= 4096);
            } catch (const Error& clean) {
                CHECK(std::string(clean.what()).find('\n') == std::string::npos);
            }
        }
    }
}

TEST_CASE("a damaged half of the peer ends in errors or in objects within its arena") {
    Link link;
    auto first = join(link, Side::first, small(64 * 1024));
    auto second = join(link, Side::second, small(64 * 1024));
    first->add_ring("r", {.max_record = 100, .capacity = 512});
    first->add_call_queue("c", {.slots = 2, .max_bytes = 64});
    first->add_blob("b", 100);
    first->publish();
    const std::byte* arena =
        second->list(Side::first)[0].memory.data(); // second's own view of the same bytes
    std::byte* half =
        first->list(Side::first)[0].memory.data() - layout::arenas_begin + sizeof(layout::SegmentHeader);
    const auto attempt = [&] {
        second->peer_state();
        second->peer_process();
        second->peer_published();
        second->doorbell().poll();
        second->ring_peer(1);
        for (const auto& object : second->list(Side::first)) {
            CHECK(object.memory.data() >= arena);
            CHECK(object.memory.data() + object.memory.size() <= arena + 64 * 1024);
        }
        second->find_ring(Side::first, "r");
        second->find_call_queue(Side::first, "c");
        second->copy_blob(Side::first, "b");
    };
    std::vector<std::byte> saved(512 + 3 * sizeof(layout::DirectoryEntry));
    for (std::size_t from = 0; from < saved.size(); from += 8) {
        std::memcpy(saved.data(), half, saved.size());
        overwrite_each(half, from, from + 8, attempt);
        std::memcpy(half, saved.data(), saved.size());
    }
    const auto before = now_ns();
    second->doorbell().wait(1ms);
    CHECK(now_ns() - before < 20'000'000'000);
}

TEST_CASE("a ring with a damaged header is refused or works within bounds") {
    for (std::size_t from = 0; from < sizeof(layout::RingHeader); from += 8) {
        Pair pair(small(8192));
        RingWriter writer(pair.first->add_ring("r", tiny()));
        RingReader back(pair.first->add_ring("back", tiny(Side::second)));
        pair.first->publish();
        use(writer);
        for (const auto* name : {"r", "back"})
            overwrite_each(memory_of(*pair.first, Side::first, name), from, from + 8, [&] {
                const auto ring = pair.second->find_ring(Side::first, name);
                if (ring->writer == Side::first) {
                    RingReader reader(*ring);
                    use(reader);
                } else {
                    RingWriter hostile_input(*ring);
                    use(hostile_input);
                }
            });
    }
}

TEST_CASE("a ring whose header or records are damaged in use ends cleanly on both sides") {
    for (std::size_t from = 0; from < sizeof(layout::RingHeader) + 256; from += 8) {
        Pair pair(small(4096));
        RingWriter writer(pair.first->add_ring("r", tiny()));
        pair.first->publish();
        RingReader reader(*pair.second->find_ring(Side::first, "r"));
        std::byte* memory = memory_of(*pair.first, Side::first, "r");
        use(writer);
        overwrite_each(memory, from, from + 8, [&] {
            use(reader);
            use(writer);
            use(reader);
        });
    }
}

TEST_CASE("a call queue with a damaged header or slot is refused or works within bounds") {
    constexpr std::size_t slot = sizeof(layout::CallQueueHeader) + sizeof(layout::CallTimes);
    for (std::size_t from = 0; from < slot + sizeof(layout::CallSlot); from += 8) {
        Pair pair(small(4096));
        pair.first->add_call_queue("c", {.slots = 1, .max_bytes = 64});
        pair.first->publish();
        std::byte* memory = memory_of(*pair.first, Side::first, "c");
        overwrite_each(memory, from, from + 8, [&] {
            CallClient client(*pair.first->find_call_queue(Side::first, "c"));
            CallServer server(*pair.second->find_call_queue(Side::first, "c"));
            const Reply reply = client.call(bytes_of("abc"), 1us);
            CHECK(reply.bytes.size() <= 64);
            for (int i = 0; i < 3; ++i)
                if (auto call = server.take(0ns)) {
                    CHECK(call->arguments().size() <= 64);
                    call->reply(CallStatus::ok, call->arguments());
                }
            client.counters();
        });
    }
}

TEST_CASE("a submitted call whose slot is damaged is taken within bounds or not at all") {
    constexpr std::size_t slot = sizeof(layout::CallQueueHeader) + sizeof(layout::CallTimes);
    for (std::size_t at = 0; at < sizeof(layout::CallSlot); ++at) {
        for (const unsigned value : values) {
            Pair pair(small(4096));
            CallClient client(pair.first->add_call_queue("c", {.slots = 2, .max_bytes = 64}));
            pair.first->publish();
            CallServer server(*pair.second->find_call_queue(Side::first, "c"));
            auto* memory = memory_of(*pair.first, Side::first, "c");
            auto& raw = *reinterpret_cast<layout::CallSlot*>(memory + slot);
            raw.request.deadline_ns.store(~std::uint64_t{0});
            raw.request.word.store(call_word(layout::CallState::submitted, 1, 8));
            memory[slot + at] = static_cast<std::byte>(value);
            for (int i = 0; i < 3; ++i)
                if (auto call = server.take(0ns)) CHECK(call->arguments().size() <= 64);
        }
    }
}

TEST_CASE("while another process overwrites everything, nothing crashes, hangs or leaves its bounds") {
    Pair pair(small(16 * 1024));
    const RingHandle written = pair.first->add_ring("r", tiny());
    CallClient client(pair.first->add_call_queue("c", {.slots = 3, .max_bytes = 64}), {.spin = 5us});
    const auto end = pair.first->add_blob("end", 8);
    pair.first->publish();
    const RingHandle read = *pair.second->find_ring(Side::first, "r");
    auto writer = std::make_unique<RingWriter>(written);
    auto reader = std::make_unique<RingReader>(read);
    CallServer server(*pair.second->find_call_queue(Side::first, "c"), {.spin = 5us});
    std::byte* begin = memory_of(*pair.first, Side::first, "r");
    std::atomic<bool> stop{false};
    std::thread scribbler([&] {
        std::uint64_t random = 88172645463325252ULL;
        const auto words = static_cast<std::size_t>(end.data() - begin) / 8;
        while (!stop) {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            auto* word = reinterpret_cast<std::uint64_t*>(begin) + random % words;
            // Mostly small numbers: those are the lengths, states and positions that look possible.
            const std::uint64_t value = random % 3 == 0 ? random : (random >> 40) % 600;
            std::atomic_ref<std::uint64_t>(*word).store(value, std::memory_order_relaxed);
            std::this_thread::yield();
        }
    });
    std::thread worker([&] {
        while (!stop)
            if (auto call = server.take(100us)) {
                if (call->arguments().size() > 64) std::abort();
                call->reply(CallStatus::ok, call->arguments());
            }
    });
    std::size_t too_long = 0;
    const auto until = deadline_after(std::chrono::milliseconds(stress(300, 30'000)));
    while (now_ns() < until) {
        writer->write(bytes_of("some text"), 0);
        if (const auto record = reader->read()) too_long += record->bytes.size() > 100 ? 1 : 0;
        if (const auto record = reader->read_newest()) too_long += record->bytes.size() > 100 ? 1 : 0;
        too_long += client.call(bytes_of("argument"), 200us).bytes.size() > 64 ? 1 : 0;
        pair.second->doorbell().wait(1us);
        try { // a side that has given up starts again, so that the test continues to test something
            if (reader->corrupt()) reader = std::make_unique<RingReader>(read);
            if (writer->corrupt()) writer = std::make_unique<RingWriter>(written);
        } catch (const Error&) {
        }
    }
    stop = true;
    scribbler.join();
    worker.join();
    CHECK(too_long == 0);
}

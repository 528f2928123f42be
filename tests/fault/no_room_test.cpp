// SPDX-License-Identifier: Apache-2.0
// A /dev/shm that is too small, and a user to whom a segment does not belong.
#include "../shm/fixture.hpp"
#include "../shm/small_shm.hpp"
#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "tests/support/skip.hpp"

#include <sys/resource.h>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// 0 if joining fails with an error that names both numbers.
int fails_naming(const Link& link, std::size_t arena_bytes, const std::string& available) {
    const std::uint64_t needed = layout::arenas_begin + 2 * arena_bytes;
    try {
        join(link, Side::first, small(arena_bytes));
    } catch (const Error& error) {
        const std::string text = error.what();
        if (text.find(std::to_string(needed) + " bytes needed") == std::string::npos ||
            text.find(available) == std::string::npos) {
            fprintf(stderr, "%s\n", text.c_str());
            return 2;
        }
        return link.files().empty() ? 0 : 3;
    }
    return 1;
}

/// Checks that `body` returns 0 in a child whose /dev/shm has 1 MiB; skips the test where no such one may be made.
template <class Body>
void check_in_small_shm(const Body& body) {
    Child child([&] { return enter_small_shm() ? body() : not_permitted; });
    const int result = child.wait();
    if (result == not_permitted)
        TANDEM_SKIP_PART("this process may not mount a separate file system");
    else
        CHECK(result == 0);
}

} // namespace

TEST_CASE("a /dev/shm of 1 MiB is an error that names both sizes, and a segment that fits is created") {
    Link link;
    check_in_small_shm([&] {
        // A page or so of the 1 MiB may be the file system's own.
        const int failed = fails_naming(link, std::size_t{4} << 20, "10");
        if (failed != 0) return failed;
        auto fits = join(link, Side::first, small(256 * 1024));
        return fails_naming(Link(), 256 * 1024, " available in /dev/shm (No space left on device)");
    });
}

TEST_CASE("a chunk without memory in a sparse segment is refused and counted, and smaller messages pass") {
    check_in_small_shm([&] {
        JoinOptions options = small(64 * 1024);
        options.sparse = true;
        Link link;
        options.chunk_pool_bytes = std::size_t{64} << 20;
        const auto first = join(link, Side::first, options);
        options.chunk_pool_bytes = 0;
        const auto second = join(link, Side::second, options);
        RingWriter writer(first->add_ring(
            "r", {.max_record = 1000, .capacity = 4096, .chunk_bytes = std::size_t{4} << 20, .chunks = 4}));
        first->publish();
        RingReader reader(*second->find_ring(Side::first, "r"));
        const std::string fits(100'000, 'f'), not_at_all(3'000'000, 'n');
        const auto sent = [&](const std::string& text) { return writer.write(bytes_of(text), 0); };
        if (sent(not_at_all) || sent(not_at_all)) return 1;
        if (!sent("small") || text_of(reader.read()->bytes) != "small") return 2;
        const auto counters = writer.counters();
        if (counters.sent != 3 || counters.refused != 2 || counters.received != 1) return 3;
        return sent(fits) && text_of(reader.read()->bytes) == fits && !sent(not_at_all) ? 0 : 4;
    });
}

TEST_CASE(
    "a ring of a sparse segment takes memory with its first message, which is refused if there is none") {
    check_in_small_shm([&] {
        JoinOptions options = small(64 * 1024);
        options.sparse = true;
        Link link;
        options.chunk_pool_bytes = std::size_t{4} << 20;
        const auto first = join(link, Side::first, options);
        options.chunk_pool_bytes = 0;
        const auto second = join(link, Side::second, options);
        RingWriter large(first->add_ring("large", {.max_record = 1000, .capacity = std::size_t{2} << 20}));
        RingWriter fits(first->add_ring("fits", {.max_record = 1000, .capacity = 64 * 1024}));
        first->publish();
        RingReader large_reader(*second->find_ring(Side::first, "large"));
        RingReader fits_reader(*second->find_ring(Side::first, "fits"));
        const auto sent = [](RingWriter& writer) { return writer.write(bytes_of("message"), 0); };
        if (sent(large) || large.reserve(10).data() != nullptr || large_reader.read()) return 1;
        const auto counters = large.counters();
        if (counters.sent != 2 || counters.refused != 2) return 2;
        return sent(fits) && text_of(fits_reader.read()->bytes) == "message" ? 0 : 3;
    });
}

TEST_CASE("a long call in a full /dev/shm fails with the reason, and short ones still work") {
    const bool sparse = GENERATE(true, false);
    check_in_small_shm([&] {
        JoinOptions options = small(256 * 1024);
        options.sparse = sparse;
        Link link;
        const auto first = join(link, Side::first, options);
        const auto second = join(link, Side::second, options);
        CallServer server(second->add_call_queue(
            "q", {.callers = Side::first, .slots = 2, .max_bytes = std::size_t{3} << 20}));
        second->publish();
        CallClient client(*first->find_call_queue(Side::second, "q"));
        const std::string long_text(2'000'000, 'a');
        if (const Reply reply = client.call(bytes_of(long_text), 1s);
            reply.status != CallStatus::overload ||
            reply.text() != "arguments of 2000000 bytes do not fit into the free memory of /dev/shm")
            return 1;
        std::thread worker([&] {
            server.take(10s)->reply(CallStatus::ok, long_text);
            server.take(10s)->reply(CallStatus::ok, std::string("short"));
        });
        const Reply reply = client.call(bytes_of("short"), 10s);
        const bool goes_on = client.call(bytes_of("short"), 10s).text() == "short";
        worker.join();
        return goes_on && reply.status == CallStatus::exception &&
                       reply.text() == "the results do not fit into the free memory of /dev/shm"
                   ? 0
                   : 2;
    });
}

TEST_CASE("a ring continues with the chunks for which there is memory") {
    check_in_small_shm([&] {
        JoinOptions options = small(64 * 1024);
        options.sparse = true;
        Link link;
        options.chunk_pool_bytes = std::size_t{2} << 20;
        const auto first = join(link, Side::first, options);
        options.chunk_pool_bytes = 0;
        const auto second = join(link, Side::second, options);
        constexpr std::size_t large = 300'000; // two of them fit, of four
        RingWriter writer(
            first->add_ring("r", {.max_record = 1000, .capacity = 4096, .chunk_bytes = large, .chunks = 4}));
        first->publish();
        RingReader reader(*second->find_ring(Side::first, "r"));
        const auto image = [](std::uint64_t i) {
            return std::string(large, static_cast<char>('a' + i % 26));
        };
        std::uint64_t sent = 0;
        while (sent < 20) // the oldest make room, as if there were two chunks
            if (++sent; !writer.write(bytes_of(image(sent)), 0)) return 1;
        for (std::uint64_t i = 19; i <= 20; ++i)
            if (const auto record = reader.read(); !record || text_of(record->bytes) != image(i)) return 2;
        while (sent < 40) {
            if (++sent; !writer.write(bytes_of(image(sent)), 0)) return 3;
            if (const auto record = reader.read(); !record || text_of(record->bytes) != image(sent)) return 4;
        }
        const auto c = writer.counters();
        return c.sent == 40 && c.received == 22 && c.overwritten == 18 && c.refused == 0 ? 0 : 5;
    });
}

TEST_CASE("a limit on the size of files is an error that names the bytes needed and why") {
    Link link;
    Child child([&] {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1 << 20, 1 << 20};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return not_permitted;
        return fails_naming(link, std::size_t{4} << 20, "(File too large)");
    });
    CHECK(child.wait() == 0);
}

TEST_CASE("a long call beyond the limit of file sizes fails with the limit as the reason, and short ones "
          "still work") {
    Child child([] {
        Link link;
        const auto first = join(link, Side::first, small(256 * 1024));
        const auto second = join(link, Side::second, small(256 * 1024));
        CallServer server(second->add_call_queue(
            "q", {.callers = Side::first, .slots = 2, .max_bytes = std::size_t{3} << 20}));
        second->publish();
        CallClient client(*first->find_call_queue(Side::second, "q"));
        const rlimit limit{1 << 20, 1 << 20};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return not_permitted;
        const std::string long_text(2'000'000, 'a');
        if (client.call(bytes_of(long_text), 1s).text() !=
            "arguments of 2000000 bytes exceed this process's limit of file sizes; raise it (ulimit -f)")
            return 1;
        std::thread worker([&] {
            server.take(10s)->reply(CallStatus::ok, long_text);
            server.take(10s)->reply(CallStatus::ok, std::string("short"));
        });
        const std::string refused = client.call(bytes_of("short"), 10s).text();
        const bool goes_on = client.call(bytes_of("short"), 10s).text() == "short";
        worker.join();
        return goes_on && refused ==
                              "the results exceed the limit of file sizes of the process that executes "
                              "the call; raise it (ulimit -f)"
                   ? 0
                   : 2;
    });
    CHECK(child.wait() == 0);
}

TEST_CASE("an object without memory in a sparse segment is an error that names both sizes") {
    check_in_small_shm([&] {
        JoinOptions options = small(256 * 1024);
        options.sparse = true;
        // Each finds room for its arena, which is not taken yet; for all of them there is none.
        Link links[3];
        std::vector<std::unique_ptr<Segment>> segments;
        for (const auto& link : links) segments.push_back(join(link, Side::first, options));
        try {
            for (const auto& segment : segments) segment->add_blob("b", 250'000);
            return 1;
        } catch (const Error& error) {
            const std::string text = error.what();
            return text.find("bytes needed, ") != std::string::npos &&
                           text.find(" available in /dev/shm") != std::string::npos
                       ? 0
                       : (fprintf(stderr, "%s\n", text.c_str()), 2);
        }
    });
}

TEST_CASE("another user joins a separate segment whichever side is free and cannot remove this one") {
    if (geteuid() != 0) TANDEM_SKIP("only root can become another user");
    Link link;
    auto first = join(link, Side::first);
    Child stranger([&] {
        constexpr uid_t nobody = 65534;
        if (setgid(nobody) != 0 || setuid(nobody) != 0) return not_permitted;
        for (const Side side : {Side::first, Side::second}) {
            const auto own = join(link, side);
            if (own->generation() == first->generation() || own->peer_state() != PeerState::absent) return 1;
            if (own->ignored_file() != first->path()) return 2;
        }
        remove_dead(link.name);
        return link.files().size() == 1 ? 0 : 3;
    });
    const int result = stranger.wait();
    if (result == not_permitted)
        TANDEM_SKIP_PART("this process may not become another user");
    else
        CHECK(result == 0);
    CHECK(first->peer_state() == PeerState::absent);
    auto second = join(link, Side::second);
    CHECK(second->generation() == first->generation());
}

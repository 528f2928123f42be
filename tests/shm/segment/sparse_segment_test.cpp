// SPDX-License-Identifier: Apache-2.0
// Segments whose chunks take memory when they are first used.
#include "tests/shm/fixture.hpp"
#include "tests/support/skip.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

constexpr std::size_t mib = std::size_t{1} << 20, large_chunk = 4 * mib;
constexpr std::uint32_t chunks = 4;

JoinOptions sparse(std::size_t chunk_pool_bytes) {
    JoinOptions options = small();
    options.chunk_pool_bytes = chunk_pool_bytes;
    options.sparse = true;
    return options;
}

/// The first side has room for loans, as a half that knows its ports; the second asks for none.
struct SparsePair {
    SparsePair()
        : first(join(link, Side::first, sparse(chunks * large_chunk + mib))),
          second(join(link, Side::second, sparse(0))),
          writer(first->add_ring("r", {.max_record = 1000, .chunk_bytes = large_chunk, .chunks = chunks})),
          reader((first->publish(), *second->find_ring(Side::first, "r"))) {}
    std::uint64_t memory() const {
        struct stat file {};
        REQUIRE(stat(first->path().c_str(), &file) == 0);
        return static_cast<std::uint64_t>(file.st_blocks) * 512;
    }
    Link link;
    std::unique_ptr<Segment> first, second;
    RingWriter writer;
    RingReader reader;
};

} // namespace

TEST_CASE("a sparse segment takes memory only for its objects and for used chunks") {
    const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    SparsePair pair;
    constexpr std::uint64_t records = 256 * 1024;
    const std::uint64_t idle = pair.memory();
    CHECK(idle < layout::arenas_begin + records); // the header of the ring
    REQUIRE(pair.writer.write(bytes_of("first"), 0));
    REQUIRE(pair.reader.read());
    const std::uint64_t without = pair.memory();
    CHECK(without - idle <= records + layout::page); // its records, and no chunk
    CHECK(without >= idle + records - 2 * layout::page);
    const std::string image(mib + 1, 'i');
    REQUIRE(pair.writer.write(bytes_of(image), 0));
    CHECK(pair.memory() - without >= image.size());
    CHECK(pair.memory() - without <= 2 * mib + page); // of one chunk, as much as is needed
    CHECK(text_of(pair.reader.read()->bytes) == image);
    for (int i = 0; i < 20; ++i) {
        REQUIRE(pair.writer.write(bytes_of(image), 0));
        REQUIRE(pair.reader.read());
    }
    const std::uint64_t warm = pair.memory();
    CHECK(warm - without <= chunks * (2 * mib + page));
    for (int i = 0; i < 20; ++i) pair.writer.write(bytes_of(image), 0);
    CHECK(pair.memory() == warm);
    const auto c = pair.writer.counters();
    CHECK(c.refused == 0);
    CHECK(c.sent == 42);
    CHECK(c.received == 22);
    CHECK(c.waiting() <= chunks);
}

TEST_CASE("a sparse segment takes no more memory in a process that locks its future memory") {
    if (mlockall(MCL_FUTURE) != 0) TANDEM_SKIP("this user may not lock memory");
    {
        SparsePair pair; // both sides are mapped here
        CHECK(pair.memory() < layout::arenas_begin + 256 * 1024);
        REQUIRE(pair.writer.write(bytes_of("first"), 0));
        CHECK(text_of(pair.reader.read()->bytes) == "first");
        CHECK(pair.memory() < layout::arenas_begin + mib);
    }
    munlockall();
}

TEST_CASE("payloads that grow in a chunk of a sparse segment stay whole") {
    SparsePair pair;
    for (std::size_t bytes = 2000; bytes <= large_chunk; bytes = bytes * 3 / 2) {
        const std::string text(bytes, static_cast<char>('a' + bytes % 26));
        REQUIRE(pair.writer.write(bytes_of(text), 0));
        const auto record = pair.reader.read();
        REQUIRE(record);
        CHECK(text_of(record->bytes) == text);
    }
}

TEST_CASE(
    "a side that joins a sparse segment, again or for the first time, reserves no memory for unused parts") {
    SparsePair pair;
    const std::uint64_t before = pair.memory();
    CHECK(pair.second->generation() == pair.first->generation());
    pair.second.reset();
    // Its side was taken before, so it makes the next generation, which has room for what the first side
    // wants.
    const auto again = join(pair.link, Side::second, sparse(0));
    struct stat file {};
    REQUIRE(stat(again->path().c_str(), &file) == 0);
    CHECK(static_cast<std::size_t>(file.st_size) > chunks * large_chunk);
    CHECK(static_cast<std::uint64_t>(file.st_blocks) * 512 <= before);
}

TEST_CASE("a side that needs more room for chunks than there is creates the next generation") {
    Link link;
    const auto first = join(link, Side::first, sparse(0));
    const auto second = join(link, Side::second, sparse(chunks * large_chunk + mib));
    CHECK(second->generation() == first->generation() + 1);
    CHECK(first->superseded());
    CHECK_NOTHROW(second->add_ring("r", {.max_record = 1000, .chunk_bytes = large_chunk, .chunks = chunks}));
}

TEST_CASE("a blob that claims more bytes than its file has memory for is not copied") {
    const Link link;
    auto first = join(link, Side::first, sparse(std::size_t{1} << 34)),
         second = join(link, Side::second, sparse(0));
    first->add_blob("table", 100);
    first->publish();
    CHECK(second->copy_blob(Side::first, "table")->size() == 100);
    const std::uint64_t claimed = std::uint64_t{1} << 33;
    const FileDescriptor file(open(first->path().c_str(), O_RDWR | O_CLOEXEC));
    const std::size_t entry = sizeof(layout::SegmentHeader) + offsetof(layout::SideHeader, directory);
    REQUIRE(pwrite(file.get(), &claimed, sizeof claimed,
                   static_cast<off_t>(entry + offsetof(layout::DirectoryEntry, bytes))) == sizeof claimed);
    CHECK_THROWS_WITH(second->copy_blob(Side::first, "table"),
                      Catch::Contains("blob 'table' of side first claims"));
}

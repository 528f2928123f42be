// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/mcap/memory_sink.hpp"
#include "tests/support/allocations.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tandem::mcap;
using tandem::test::bytes_of;
using tandem::test::MemorySink;

namespace {

std::string hex(const Bytes& bytes) {
    std::string text;
    for (const std::byte byte : bytes) {
        text += "0123456789abcdef"[std::to_integer<int>(byte >> 4)];
        text += "0123456789abcdef"[std::to_integer<int>(byte & std::byte{15})];
    }
    return text;
}

} // namespace

// The case OneMessage-ch-chx-mx-rch-rsh-st-sum of the format's conformance set, whose file has the SHA-256 of these bytes.
TEST_CASE("a file with one message equals that of the reference writers byte for byte") {
    MemorySink sink;
    McapWriter writer(sink, {});
    const auto schema = writer.add_schema("Example", "c", bytes_of("\x04\x05\x06"));
    const auto channel = writer.add_channel("example", schema, "a", {{"foo", "bar"}});
    writer.write(channel, 10, 2, 1, bytes_of("\x01\x02\x03"));
    writer.close();
    CHECK(hex(sink.bytes) ==
          "894d434150300d0a0108000000000000000000000000000000069b000000000000000200000000000000020000000000"
          "0000730000000000000025aa6fd80000000073000000000000000319000000000000000100070000004578616d706c65"
          "01000000630300000004050604260000000000000001000100070000006578616d706c6501000000610e000000030000"
          "00666f6f0300000062617205190000000000000001000a00000002000000000000000100000000000000010203071600"
          "000000000000010010000000020000000000000051000000000000000f0400000000000000500b906503190000000000"
          "00000100070000004578616d706c6501000000630300000004050604260000000000000001000100070000006578616d"
          "706c6501000000610e00000003000000666f6f030000006261720b380000000000000001000000000000000100010000"
          "00000000000000000001000000020000000000000002000000000000000a00000001000100000000000000084a000000"
          "00000000020000000000000002000000000000001900000000000000a4000000000000000a0000000100bd0000000000"
          "00001f0000000000000000000000730000000000000073000000000000000e110000000000000003e900000000000000"
          "22000000000000000e1100000000000000040b010000000000002f000000000000000e11000000000000000b3a010000"
          "0000000041000000000000000e1100000000000000087b010000000000005300000000000000021400000000000000e9"
          "00000000000000ce010000000000009909a6e7894d434150300d0a");
}

TEST_CASE("full and flushed chunks are written at once, a message in an open chunk is not") {
    MemorySink sink;
    McapWriter writer(sink, {.library = "test", .chunk_size = 1000});
    const auto channel = writer.add_channel("topic", 0, "cdr");
    writer.write(channel, 0, 1, 1, bytes_of(std::string(600, 'a')));
    CHECK(sink.flushed == 0);
    writer.write(channel, 1, 2, 2, bytes_of(std::string(600, 'b'))); // does not fit
    const std::size_t first = sink.flushed;
    CHECK(first > 600);
    CHECK(first < 1200);
    writer.flush();
    CHECK(sink.flushed > first + 600);
    CHECK(sink.flushed == writer.bytes_written());
    writer.write(channel, 2, 3, 3,
                 bytes_of(std::string(5000, 'c'))); // longer than a chunk, so it gets a separate one
    writer.flush();
    CHECK(sink.flushed > first + 5600);
}

TEST_CASE("messages allocate no memory after the first full chunk") {
    for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd}) {
        std::filesystem::path file = std::filesystem::temp_directory_path() / "tandem-mcap-allocations";
        file += std::to_string(getpid());
        FileSink sink(file);
        McapWriter writer(sink, {.library = "test", .compression = compression, .chunk_size = 64 * 1024});
        const auto channel = writer.add_channel("topic", 0, "cdr");
        const std::string data(64, 'a');
        const auto write = [&](int count) {
            for (int i = 0; i < count; ++i) writer.write(channel, 0, 1, 1, bytes_of(data));
        };
        write(100'000);
        const long before = allocations();
        write(10'000); // 15 chunks: their indexes may allocate
        CHECK(allocations() - before < 100);
        std::filesystem::remove(file);
    }
}

TEST_CASE("a write error is reported in one line that names file and cause, and is permanent") {
    FileSink sink("/dev/full");
    McapWriter writer(sink, {.library = "test"});
    const auto channel = writer.add_channel("topic", 0, "cdr");
    writer.write(channel, 0, 1, 1, bytes_of("data"));
    const char* const line = "/dev/full cannot be written: No space left on device";
    CHECK_THROWS_WITH(writer.flush(), line);
    CHECK_THROWS_WITH(writer.flush(), line);
    CHECK_THROWS_WITH(writer.close(), line);
    CHECK_THROWS_WITH(FileSink("/no/such/folder/file.mcap"),
                      "/no/such/folder/file.mcap cannot be written: No such file or directory");
}

TEST_CASE("data that the format cannot hold are refused, and the file remains usable") {
    MemorySink sink;
    McapWriter writer(sink, {.library = "test"});
    CHECK_THROWS_WITH(writer.write(1, 0, 0, 0, {}), "MCAP: a message on channel 1, which was not added");
    CHECK_THROWS_WITH(writer.add_channel("a", 1, "cdr"),
                      "MCAP: the channel a has the schema 1, which was not added");
    CHECK_THROWS_WITH(writer.add_channel("\xFF", 0, "cdr"), Catch::Contains("is not UTF-8"));
    for (int i = 1; i <= 65'535; ++i) REQUIRE(writer.add_schema("name", "", {}) == i);
    CHECK_THROWS_WITH(writer.add_schema("name", "", {}), "MCAP: a file has at most 65535 schemas");
    for (int i = 1; i <= 65'535; ++i) REQUIRE(writer.add_channel("topic", 65'535, "cdr") == i);
    CHECK_THROWS_WITH(writer.add_channel("topic", 1, "cdr"), "MCAP: a file has at most 65535 channels");
    writer.write(65'535, 0, 1, 1, {});
    writer.close();
    CHECK_THROWS_WITH(writer.write(1, 0, 1, 1, {}), "MCAP: the file has been closed");
    CHECK_THROWS_WITH(McapWriter(sink, {.library = "test", .chunk_size = (1UL << 30U) + 1}),
                      "MCAP: a chunk is limited to 1 GiB");
}

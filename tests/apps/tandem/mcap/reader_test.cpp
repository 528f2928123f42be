// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/format/encode.hpp"
#include "tests/apps/tandem/mcap/sample.hpp"
#include "tests/support/stress.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <numeric>

using namespace tandem::mcap;
using namespace tandem::test;

namespace {

std::vector<unsigned> first_numbers(unsigned count) {
    std::vector<unsigned> all(count);
    std::iota(all.begin(), all.end(), 0);
    return all;
}

constexpr Compression all_compressions[] = {Compression::none, Compression::lz4, Compression::zstd};

} // namespace

TEST_CASE("written files are read back with every compression, with and without chunks and summary") {
    for (const auto compression : all_compressions)
        for (const std::size_t chunk_size : {0, 1, 4000, 1 << 20})
            for (const bool summary : {true, false}) {
                CAPTURE(compression, chunk_size, summary);
                WriterOptions options{
                    .library = "test", .compression = compression, .chunk_size = chunk_size};
                if (!summary) options.summary.statistics = false;
                const TemporaryFile file(sample(500, options));
                McapReader reader(file.path());
                const Contents& contents = reader.contents();
                CHECK(contents.complete);
                CHECK(contents.problems.empty());
                CHECK(contents.by_summary == (summary && chunk_size > 0));
                CHECK(contents.header.library == "test");
                REQUIRE(contents.schemas.size() == 1);
                CHECK(contents.schemas.at(1).name == "Number");
                REQUIRE(contents.channels.size() == 2);
                CHECK(contents.channels.at(1).metadata == StringMap{{"link", "robot"}});
                CHECK(contents.channels.at(2).topic == "odd");
                CHECK(contents.statistics.message_count == 500);
                CHECK(contents.statistics.start_time == 1000);
                CHECK(contents.statistics.end_time == 1499);
                CHECK(contents.statistics.channel_message_counts ==
                      std::vector<std::pair<std::uint16_t, std::uint64_t>>{{1, 250}, {2, 250}});
                CHECK(numbers(reader) == first_numbers(500));
                CHECK(numbers(reader, {.in_log_time_order = true}) == first_numbers(500));
                REQUIRE(contents.metadata.size() == 1);
                CHECK(reader.metadata(contents.metadata[0]).metadata.at("tick") == "10 ms");
                REQUIRE(contents.attachments.size() == 1);
                CHECK(std::ranges::equal(reader.attachment_data(contents.attachments[0]),
                                         bytes_of("module arm {};")));
            }
}

TEST_CASE("a query selects a range of times, including both ends, and channels") {
    const TemporaryFile file(sample(500, {.library = "test", .chunk_size = 1000}));
    McapReader reader(file.path());
    CHECK(numbers(reader, {.from = 1010, .to = 1012}) == std::vector<unsigned>{10, 11, 12});
    CHECK(numbers(reader, {.from = 1010, .to = 1014, .channels = {{2}}}) == std::vector<unsigned>{11, 13});
    CHECK(numbers(reader, {.from = 1498}) == std::vector<unsigned>{498, 499});
    CHECK(numbers(reader, {.channels = std::set<std::uint16_t>{}}).empty());
}

TEST_CASE("log-time order merges chunks that overlap and keeps the order of the file for equal times") {
    MemorySink sink;
    McapWriter writer(sink, {.library = "test", .chunk_size = 500});
    const auto channel = writer.add_channel("a", 0, "text");
    std::vector<std::pair<std::uint64_t, std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const std::uint64_t time = i * 7919ULL % 100; // each chunk covers nearly all times
        expected.emplace_back(time, i);
        writer.write(channel, i, time, time, bytes_of("data"));
    }
    writer.close();
    std::ranges::stable_sort(expected, {}, [](const auto& message) { return message.first; });
    const TemporaryFile file(sink.bytes);
    McapReader reader(file.path());
    CHECK(reader.contents().blocks.size() > 50);
    auto cursor = reader.messages({.in_log_time_order = true});
    for (const auto& [time, sequence] : expected) {
        const auto message = cursor.next();
        REQUIRE(message);
        REQUIRE(std::pair(message->log_time, message->sequence) == std::pair(time, sequence));
    }
    CHECK(!cursor.next());
}

TEST_CASE("a file truncated anywhere is read up to its last complete chunk, or uncompressed up to its last "
          "complete message") {
    for (const auto compression : all_compressions)
        for (const std::size_t chunk_size : {0, 300}) {
            const Bytes whole =
                sample(40, {.library = "test", .compression = compression, .chunk_size = chunk_size});
            const TemporaryFile file;
            std::size_t before = 0;
            const std::size_t header = sizeof(magic) + 9 + 4 + 8;
            for (std::size_t size = 0; size < whole.size(); ++size) {
                CAPTURE(compression, chunk_size, size);
                file.set(ByteView(whole).first(size));
                if (size < header) {
                    REQUIRE_THROWS_WITH(McapReader(file.path()), Catch::Contains("is not an MCAP file"));
                    continue;
                }
                McapReader reader(file.path());
                REQUIRE(!reader.contents().complete);
                REQUIRE(reader.contents().problems.size() == 1);
                const auto found = numbers(reader);
                REQUIRE(found == first_numbers(static_cast<unsigned>(found.size())));
                REQUIRE(found.size() == reader.contents().statistics.message_count);
                REQUIRE(found.size() >= before); // more bytes, more messages
                if (compression == Compression::none && found.size() > before)
                    REQUIRE(found.size() == before + 1); // message by message
                before = found.size();
            }
            CHECK(before == 40);
        }
}

TEST_CASE("a flipped bit costs the messages around it and produces no wrong messages") {
    const std::size_t step =
        tandem::test::stress(1) > 1 ? 3 : 11; // flips every bit position, in every byte of a record
    for (const auto compression : all_compressions) {
        const Bytes whole = sample(60, {.library = "test", .compression = compression, .chunk_size = 1000});
        const TemporaryFile file;
        for (std::size_t bit = 0; bit < whole.size() * 8; bit += step) {
            CAPTURE(compression, bit);
            Bytes damaged = whole;
            damaged[bit / 8] ^= std::byte(1U << (bit % 8));
            file.set(damaged);
            try {
                McapReader reader(file.path());
                for (const bool by_time : {false, true}) {
                    const auto found = numbers(reader, {.in_log_time_order = by_time});
                    const auto all = first_numbers(60);
                    REQUIRE(std::ranges::includes(all, found));
                }
            } catch (const Error& error) {
                REQUIRE_THAT(error.what(), Catch::StartsWith(file.path().string() + ": "));
            }
        }
    }
}

TEST_CASE("a damaged chunk is reported in one line and skipped, and the others are read") {
    Bytes bytes = sample(100, {.library = "test", .chunk_size = 500});
    const TemporaryFile whole(bytes);
    const auto block = McapReader(whole.path()).contents().blocks.at(1);
    bytes[block.offset + 200] ^= std::byte{1};
    const TemporaryFile file(bytes);
    McapReader reader(file.path());
    CHECK(reader.contents().by_summary);
    auto cursor = reader.messages();
    const auto found = numbers(cursor);
    CHECK(found.size() > 70);
    CHECK(found.size() < 100);
    REQUIRE(cursor.problems().size() == 1);
    CHECK(cursor.problems()[0] == file.path().string() + ": the Chunk at byte " +
                                      std::to_string(block.offset) +
                                      " does not match its CRC-32: its messages are skipped");
}

TEST_CASE("a damaged summary is reported, and the file is read from the beginning") {
    Bytes bytes = sample(100, {.library = "test", .chunk_size = 500});
    bytes[bytes.size() - 60] ^= std::byte{1};
    const TemporaryFile file(bytes);
    McapReader reader(file.path());
    CHECK(!reader.contents().by_summary);
    CHECK(reader.contents().complete);
    CHECK(reader.contents().problems ==
          std::vector{file.path().string() + ": the summary is damaged (it does not match the CRC-32 in the "
                                             "footer): reading from the beginning"});
    CHECK(numbers(reader) == first_numbers(100));
}

TEST_CASE("a file that is not an MCAP file is refused in one line") {
    const TemporaryFile file;
    const auto name = file.path().string();
    CHECK_THROWS_WITH(McapReader(file.path()), name + ": is not an MCAP file: it is empty");
    file.set(bytes_of("#ROSBAG V2.0\n"));
    CHECK_THROWS_WITH(McapReader(file.path()),
                      name + ": is not an MCAP file: it does not begin with \\x89MCAP0\\r\\n");
    CHECK_THROWS_WITH(McapReader("/no/file"), "/no/file: cannot be opened: No such file or directory");
    CHECK_THROWS_WITH(McapReader("/dev/zero"), "/dev/zero: cannot be read: it is not a regular file");
}

namespace {

/// The beginning of a file, to which a test appends records as another writer would.
Bytes begun() {
    Bytes bytes;
    const auto start = std::as_bytes(std::span(magic));
    bytes.assign(start.begin(), start.end());
    append(bytes, Header{"", "other"});
    return bytes;
}

void end(Bytes& bytes) {
    append(bytes, DataEnd{});
    append(bytes, Footer{});
    const auto start = std::as_bytes(std::span(magic));
    bytes.insert(bytes.end(), start.begin(), start.end());
}

void append_chunk(Bytes& bytes, ByteView stored, std::uint64_t uncompressed_size, const char* compression) {
    append_head(bytes, ChunkHead{0, 0, uncompressed_size, 0, compression, stored.size()});
    bytes.insert(bytes.end(), stored.begin(), stored.end());
}

Bytes one_message() {
    Bytes records;
    append(records, Channel{0, 0, "topic", "text", {}});
    append(records, Message{0, 0, 1000, 999, {}});
    return records;
}

} // namespace

TEST_CASE("records of unknown and private op codes are skipped, in the data and in chunks") {
    Bytes bytes = begun(), unknown = {std::byte{0x42}};
    unknown.resize(9 + 3);
    unknown[1] = std::byte{3};
    Bytes secret = unknown;
    secret[0] = std::byte{0x80};
    bytes.insert(bytes.end(), unknown.begin(), unknown.end());
    Bytes records = secret;
    const Bytes message = one_message();
    records.insert(records.end(), message.begin(), message.end());
    records.insert(records.end(), unknown.begin(), unknown.end());
    append_chunk(bytes, records, records.size(), "");
    bytes.insert(bytes.end(), secret.begin(), secret.end());
    end(bytes);
    const TemporaryFile file(bytes);
    McapReader reader(file.path());
    CHECK(reader.contents().problems.empty());
    CHECK(numbers(reader) == std::vector{0U});
}

TEST_CASE("a chunk with a wrong size or an unknown compression is reported and allocates no memory") {
    const Bytes message = one_message();
    Compressor zstd(Compression::zstd), lz4(Compression::lz4);
    struct {
        const char* compression;
        ByteView stored;
        std::uint64_t size;
        const char* line;
    } cases[] = {
        {"br", message, message.size(), "compression \"br\" is unknown: expected lz4, zstd or none"},
        {"", message, message.size() + 1, "uncompressed data do not have the length that the chunk states"},
        {"zstd", zstd.compress(message), message.size() + 1, "zstd data are shorter than the chunk states"},
        {"zstd", zstd.compress(message), message.size() - 1,
         "zstd data are longer than the chunk states, or damaged"},
        {"zstd", zstd.compress(message), 1UL << 29U, "zstd data are shorter than the chunk states"},
        {"zstd", zstd.compress(message), 1UL << 40U, "has more than 1 GiB"},
        {"zstd", message, message.size(), "zstd data are damaged"},
        {"lz4", lz4.compress(message), message.size() + 1, "lz4 data are shorter than the chunk states"},
        {"lz4", lz4.compress(message), message.size() - 1,
         "lz4 data are longer than the chunk states, or damaged"},
        {"lz4", message, message.size(), "lz4 data are damaged"},
    };
    for (const auto& lie : cases) {
        Bytes bytes = begun();
        append_chunk(bytes, lie.stored, lie.size, lie.compression);
        append_chunk(bytes, message, message.size(), "");
        end(bytes);
        const TemporaryFile file(bytes);
        McapReader reader(file.path());
        CHECK(reader.contents().problems ==
              std::vector{file.path().string() + ": the Chunk at byte 30 " + lie.line + ": it is skipped"});
        CHECK(numbers(reader) == std::vector{0U}); // the other chunk
    }
}

TEST_CASE("a highly compressed chunk is read if its size is correct, and memory grows only with the output") {
    Bytes records = one_message();
    const Bytes zeros(10 << 20);
    append(records, Message{0, 0, 1010, 1009, zeros});
    for (const auto compression : {Compression::zstd, Compression::lz4}) {
        Compressor compressor(compression);
        Bytes bytes = begun();
        append_chunk(bytes, compressor.compress(records), records.size(), compression_name(compression));
        end(bytes);
        CHECK(bytes.size() < 100'000);
        const TemporaryFile file(bytes);
        McapReader reader(file.path());
        auto cursor = reader.messages({.from = 1001});
        const auto message = cursor.next();
        REQUIRE(message);
        CHECK(message->data.size() == zeros.size());
    }
}

TEST_CASE("messages of an undefined channel are reported once and skipped") {
    Bytes bytes = begun();
    const Bytes message = one_message();
    bytes.insert(bytes.end(), message.begin(), message.end());
    append(bytes, Message{7, 0, 1001, 1000, {}});
    append(bytes, Message{7, 0, 1002, 1001, {}});
    end(bytes);
    const TemporaryFile file(bytes);
    McapReader reader(file.path());
    auto cursor = reader.messages();
    CHECK(numbers(cursor) == std::vector{0U});
    REQUIRE(cursor.problems().size() == 1);
    CHECK_THAT(
        cursor.problems()[0],
        Catch::EndsWith("has messages of channel 7, which the file does not define: they are skipped"));
}

TEST_CASE("an attachment with damaged data is refused") {
    Bytes bytes = sample(1, {.library = "test"});
    const auto text = bytes_of("module arm {};");
    const auto at = std::search(bytes.begin(), bytes.end(), text.begin(), text.end());
    REQUIRE(at != bytes.end());
    *at ^= std::byte{1};
    const TemporaryFile file(bytes);
    McapReader reader(file.path());
    CHECK_THROWS_WITH(reader.attachment_data(reader.contents().attachments.at(0)),
                      Catch::EndsWith("does not match its CRC-32"));
}

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/check_file.hpp"
#include "apps/tandem/mcap/format/encode.hpp"
#include "tests/apps/tandem/mcap/sample.hpp"

#include <catch2/catch.hpp>

using namespace tandem::mcap;
using namespace tandem::test;

namespace {

std::vector<std::string> lines(ByteView bytes, bool errors = true) {
    const TemporaryFile file(bytes);
    std::vector<std::string> found;
    for (const auto& finding : check_file(file.path()))
        if (finding.error == errors) found.push_back(finding.line);
    return found;
}

/// The sample, changed before its CRCs are made, as a careless writer would write it.
class Careless {
  public:
    Careless() {
        const auto begin = std::as_bytes(std::span(magic));
        bytes.assign(begin.begin(), begin.end());
        append(bytes, Header{"", "other"});
    }
    template <typename Record>
    Careless& add(const Record& record) {
        append(bytes, record);
        return *this;
    }
    Careless& chunk(ChunkHead head, const Bytes& records) {
        head.uncompressed_size = head.stored_size = records.size();
        append_head(bytes, head);
        bytes.insert(bytes.end(), records.begin(), records.end());
        return *this;
    }
    std::vector<std::string> errors() { return lines(ended()); }
    std::vector<std::string> warnings() { return lines(ended(), false); }
    Bytes bytes;

  private:
    Bytes ended() const {
        Bytes all = bytes;
        append(all, DataEnd{});
        append(all, Footer{});
        const auto end = std::as_bytes(std::span(magic));
        all.insert(all.end(), end.begin(), end.end());
        return all;
    }
};

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("a file written by Tandem has no errors and no warnings") {
    for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd})
        for (const std::size_t chunk_size : {0, 1000, 1 << 20}) {
            const auto bytes =
                sample(200, {.library = "test", .compression = compression, .chunk_size = chunk_size});
            CHECK(lines(bytes).empty());
            CHECK(lines(bytes, false).empty());
        }
}

TEST_CASE("each flipped bit is an error") {
    const Bytes whole = sample(20, {.library = "test", .chunk_size = 300});
    std::size_t unnoticed = 0;
    for (std::size_t bit = 8 * 34; bit < whole.size() * 8; bit += 5) { // after the header
        Bytes damaged = whole;
        damaged[bit / 8] ^= std::byte(1U << (bit % 8));
        CAPTURE(bit);
        if (lines(damaged).empty()) ++unnoticed;
    }
    CHECK(unnoticed == 0);
}

TEST_CASE("a file truncated anywhere is incomplete") {
    const Bytes whole = sample(20, {.library = "test", .chunk_size = 300});
    for (std::size_t size = 40; size < whole.size(); ++size) {
        CAPTURE(size);
        REQUIRE(!lines(ByteView(whole).first(size)).empty());
    }
}

TEST_CASE("each rule of the data section has a line") {
    const Schema schema{1, "S", "omgidl", {std::byte{'a'}}};
    const Channel channel{1, 1, "topic", "cdr", {}};
    CHECK(Careless().add(schema).add(channel).add(Message{1, 0, 5, 5, {}}).errors().empty());
    CHECK(Careless().add(channel).errors() ==
          Lines{"the Channel at byte 30 (id 1) has the schema 1, which the file does not define before it"});
    CHECK(Careless().add(Schema{0, "S", "omgidl", {}}).errors() ==
          Lines{"the Schema at byte 30 has the id 0, which is reserved"});
    CHECK(Careless().add(Schema{1, "S", "", {std::byte{'a'}}}).errors() ==
          Lines{"the Schema at byte 30 (id 1) has data, but no encoding"});
    CHECK(Careless().add(Schema{1, "S", "", {}}).warnings() ==
          Lines{"the Schema at byte 30 (id 1) has neither encoding nor data"});
    CHECK(Careless().add(schema).add(Schema{1, "T", "omgidl", {}}).errors() ==
          Lines{"the Schema at byte 61 differs from an earlier one with the id 1"});
    CHECK(Careless().add(Message{3, 0, 5, 5, {}}).errors() ==
          Lines{"the Message at byte 30 belongs to channel 3, which the file does not define before it"});
    CHECK(Careless()
              .add(schema)
              .add(channel)
              .add(Message{1, 0, 5, 5, {}})
              .add(Message{1, 0, 4, 4, {}})
              .warnings() == Lines{"1 messages have a log time before that of an earlier message"});
    CHECK(Careless().add(MessageIndex{1, {}}).errors() ==
          Lines{"the MessageIndex at byte 30 does not follow a chunk"});
    CHECK(Careless().add(Statistics{}).errors() ==
          Lines{"the Statistics at byte 30 is not allowed in the data section"});
}

TEST_CASE("each rule of a chunk has a line") {
    Bytes records;
    append(records, Channel{1, 0, "topic", "cdr", {}});
    const std::size_t message = records.size();
    append(records, Message{1, 0, 5, 5, {}});
    CHECK(Careless().chunk({5, 5}, records).add(MessageIndex{1, {{5, message}}}).errors().empty());
    CHECK(Careless().chunk({5, 5}, records).add(MessageIndex{1, {{5, message}}}).warnings().empty());
    CHECK(Careless().chunk({5, 5}, records).warnings() ==
          Lines{"the Chunk at byte 30 has no MessageIndex for channel 1"});
    CHECK(Careless().chunk({4, 6}, records).errors() ==
          Lines{"the Chunk at byte 30: message_start_time is 4, but should be 5",
                "the Chunk at byte 30: message_end_time is 6, but should be 5"});
    CHECK(Careless().chunk({5, 5, 0, 7}, records).errors() ==
          Lines{"the Chunk at byte 30 does not match its CRC-32"});
    const auto wrong_index = Careless().chunk({5, 5}, records).add(MessageIndex{1, {{6, message}}}).errors();
    REQUIRE(wrong_index.size() == 1);
    CHECK_THAT(wrong_index[0],
               Catch::EndsWith("does not list the messages of channel 1 in the Chunk at byte 30"));
    Bytes nested = records;
    append(nested, Metadata{"name", {}});
    const auto nesting = Careless().chunk({5, 5}, nested).errors();
    REQUIRE(nesting.size() == 1);
    CHECK_THAT(nesting[0], Catch::Contains("of the Chunk at byte 30 is not allowed in a chunk"));
}

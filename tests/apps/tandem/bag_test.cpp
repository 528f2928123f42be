// SPDX-License-Identifier: Apache-2.0
// tandem bag: what a user sees of a recording.
#include "apps/tandem/bag/times.hpp"
#include "tests/apps/tandem/mcap/sample.hpp"
#include "tests/apps/tandem/program.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

using namespace tandem::mcap;
using namespace tandem::test;
using tandem::command::format_time;
using tandem::command::parse_time;

namespace {

struct BagFolder {
    BagFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "tandem-bag-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~BagFolder() { std::filesystem::remove_all(path); }
    std::string file(const char* name) const { return path / name; }
    std::filesystem::path path;
};

/// Ten seconds, a message each 100 ms on each of two topics; the number 50 is missing on the second one.
Bytes ten_seconds() {
    MemorySink sink;
    McapWriter writer(sink, {.library = "test", .compression = Compression::zstd, .chunk_size = 1000});
    const auto schema =
        writer.add_schema("RTC::TimedDouble", "omgidl", tandem::test::bytes_of("struct TimedDouble {};"));
    const auto speed = writer.add_channel("speed", schema, "cdr", {{"link", "robot"}});
    const auto angle = writer.add_channel("angle", 0, "json");
    writer.add_metadata("host", {{"name", "arm"}});
    constexpr std::uint64_t begin = 1'795'420'800'000'000'000; // 2026-11-23T08:00:00Z
    for (std::uint32_t i = 0; i <= 100; ++i) {
        const std::uint64_t time = begin + i * 100'000'000ULL;
        writer.write(speed, i, time, time, tandem::test::bytes_of("12345678"));
        if (i != 50) writer.write(angle, i, time, time, tandem::test::bytes_of("{}"));
    }
    writer.attach("arm.idl", "text/plain", begin, 0, tandem::test::bytes_of("module arm {};"));
    writer.close();
    return sink.bytes;
}

} // namespace

TEST_CASE("tandem bag info prints what a recording contains") {
    const TemporaryFile file(ten_seconds());
    const auto text = tandem_program({"bag", "info", file.path()});
    CHECK(text.exit_code == 0);
    for (const char* part :
         {"complete    yes", "library     test", "messages    201", "2026-11-23T08:00:00.000000000Z",
          "08:00:10.000000000Z, 10 s", "(zstd)", "arm.idl (text/plain), 14 B", "host: name = arm",
          "speed       101   10 Hz      0  RTC::TimedDouble  omgidl           cdr", "angle       100"})
        CHECK_THAT(text.output, Catch::Contains(part));
    const auto json = tandem_program({"bag", "info", file.path(), "--json"}).json();
    CHECK(json["complete"] == true);
    CHECK(json["messages"] == 201);
    CHECK(json["duration_s"] == 10.0);
    REQUIRE(json["topics"].size() == 2);
    CHECK(json["topics"][0]["drops"] == 0);
    CHECK(json["topics"][0]["metadata"]["link"] == "robot");
    CHECK(json["topics"][1]["drops"] == 1);
    CHECK(json["topics"][1]["message_encoding"] == "json");
    CHECK(json["attachments"][0]["bytes"] == 14);
    CHECK(json["metadata"][0]["values"]["name"] == "arm");
}

TEST_CASE("tandem bag info reports that a recording is truncated, and what is left of it") {
    const Bytes whole = ten_seconds();
    const TemporaryFile file(ByteView(whole).first(whole.size() / 2));
    const auto info = tandem_program({"bag", "info", file.path(), "--json"});
    CHECK(info.exit_code == 1);
    CHECK_THAT(info.errors, Catch::Contains("is truncated at byte "));
    CHECK(std::count(info.errors.begin(), info.errors.end(), '\n') == 1);
    const auto json = info.json();
    CHECK(json["complete"] == false);
    CHECK(json["messages"] > 50);
    CHECK(json["problems"].size() == 1);
    CHECK(tandem_program({"bag", "info", file.path()}).output_contains("is truncated at byte "));
    const auto none = tandem_program({"bag", "info", "/dev/null"});
    CHECK(none.exit_code == 1);
    CHECK(none.errors == "tandem: /dev/null: cannot be read: it is not a regular file\n");
}

TEST_CASE("tandem bag cut writes the messages of a time range and of selected topics") {
    const TemporaryFile file(ten_seconds());
    const BagFolder folder;
    const auto out = folder.file("part.mcap");
    const auto cut = tandem_program({"bag", "cut", file.path(), "-o", out, "--from", "1", "--to",
                                     "2026-11-23T17:00:02.05+09:00", "--topic", "speed"});
    CHECK(cut.errors.empty());
    REQUIRE(cut.exit_code == 0);
    CHECK_THAT(cut.output, Catch::StartsWith(out + ": 11 messages of 1 topics"));
    const auto json = tandem_program({"bag", "info", out, "--json"}).json();
    CHECK(json["messages"] == 11);
    CHECK(json["duration_s"] == 1.0);
    REQUIRE(json["topics"].size() == 1);
    CHECK(json["topics"][0]["schema"] == "RTC::TimedDouble");
    CHECK(json["topics"][0]["metadata"]["link"] == "robot");
    CHECK(json["attachments"].size() == 1);
    CHECK(json["metadata"].size() == 1);
    CHECK(json["chunks"][0]["compression"] == "zstd");
    CHECK(tandem_program({"bag", "check", out}).exit_code == 0);
}

TEST_CASE("tandem bag cut repairs a recording whose recorder was killed") {
    const Bytes whole = ten_seconds();
    const TemporaryFile file(ByteView(whole).first(whole.size() / 2));
    const BagFolder folder;
    CHECK(tandem_program({"bag", "check", file.path()}).exit_code == 1);
    const auto cut = tandem_program({"bag", "cut", file.path(), "-o", folder.file("mended.mcap")});
    CHECK(cut.exit_code == 1); // a part is lost
    CHECK_THAT(cut.errors, Catch::Contains("is truncated at byte "));
    CHECK(std::count(cut.errors.begin(), cut.errors.end(), '\n') == 1);
    CHECK(tandem_program({"bag", "check", folder.file("mended.mcap")}).exit_code == 0);
}

TEST_CASE("tandem bag cut refuses invalid requests in one line and leaves no file") {
    const BagFolder folder;
    const auto file = folder.file("whole.mcap"), out = folder.file("part.mcap");
    {
        FileSink sink(file);
        sink.write(ten_seconds());
        sink.close();
    }
    const auto errors = [&](std::vector<std::string> options, const std::string& to) {
        options.insert(options.begin(), {"bag", "cut", file, "-o", to});
        const auto result = tandem_program(options);
        CHECK(result.exit_code == 1);
        return result.errors;
    };
    CHECK(errors({"--topic", "speeed"}, out) ==
          "tandem: " + file + " has no topic speeed: it has speed, angle\n");
    CHECK(errors({"--from", "yesterday"}, out) ==
          "tandem: --from yesterday is not a valid time: expected seconds from the start, for example 1.5, "
          "or a time such as "
          "2026-11-23T08:15:00Z\n");
    CHECK(errors({"--from", "3", "--to", "2"}, out) == "tandem: --to 2 is before --from 3\n");
    CHECK(errors({}, file) == "tandem: " + file + " is the recording itself: give another output file\n");
    CHECK(errors({}, "/dev/full") == "tandem: /dev/full cannot be written: No space left on device\n");
    CHECK(!std::filesystem::exists(out));
    CHECK(std::filesystem::exists("/dev/full"));
    CHECK(tandem_program({"bag", "check", file}).output == file + ": no errors\n");
}

namespace {

/// Ten chunks of a recording of numbers as tandem record writes it. Message 5 has `odd` instead of a number.
Bytes ten_numbers(const std::string& odd = {}) {
    MemorySink sink;
    McapWriter writer(sink, {.library = "test"});
    const auto port = writer.add_channel("speed", 0, "cdr", {{"tandem.signature", "d"}});
    for (std::uint32_t i = 0; i < 10; ++i) {
        const std::string number("\0\1\0\0\0\0\0\0\0\0\0\0", 12);
        writer.write(port, i, i, i, tandem::test::bytes_of(i == 5 && !odd.empty() ? odd : number));
        writer.flush();
    }
    writer.close();
    return sink.bytes;
}

/// The recording with a wrong byte in its last but one chunk, which its summary does not show.
Bytes with_damaged_chunk() {
    Bytes bytes = ten_numbers();
    const TemporaryFile file(bytes);
    const McapReader reader(file.path());
    const auto& block = reader.contents().blocks.at(8);
    bytes[block.offset + block.length - 1] ^= std::byte{1};
    return bytes;
}

void check_loss(const Result& result, const std::string& loss) {
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.errors, Catch::Contains(loss));
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
}

} // namespace

TEST_CASE("tandem bag convert saves what is readable of a damaged recording, and fails") {
    const Bytes whole = ten_numbers();
    const auto convert = [](const TemporaryFile& file, const char* format) {
        return tandem_program({"bag", "convert", file.path(), format});
    };
    const auto rows = [](const Result& result) {
        return std::count(result.output.begin(), result.output.end(), '\n');
    };
    const TemporaryFile sound(whole), truncated(ByteView(whole).first(whole.size() / 3)),
        damaged(with_damaged_chunk()), odd(ten_numbers("no number"));
    CHECK(convert(sound, "--json").exit_code == 0);
    for (const char* format : {"--json", "--csv"}) {
        const int heads = std::string(format) == "--csv" ? 1 : 0;
        const auto half = convert(truncated, format);
        check_loss(half, "is truncated at byte ");
        CHECK(rows(half) > 2 + heads);
        const auto nine = convert(damaged, format);
        check_loss(nine, "does not match its CRC-32: its messages are skipped");
        CHECK(rows(nine) == 9 + heads);
        const auto others = convert(odd, format);
        check_loss(others, "message 5 of topic speed is skipped: ");
        CHECK(rows(others) == 9 + heads);
    }
}

TEST_CASE("tandem bag cut and info report damage that the summary does not show") {
    const TemporaryFile file(with_damaged_chunk());
    const BagFolder folder;
    const auto out = folder.file("part.mcap");
    check_loss(tandem_program({"bag", "cut", file.path(), "-o", out}), "does not match its CRC-32");
    CHECK(tandem_program({"bag", "info", out, "--json"}).json()["messages"] == 9);
    CHECK(tandem_program({"bag", "check", out}).exit_code == 0);
    Bytes bytes = ten_numbers();
    {
        const TemporaryFile sound(bytes);
        const McapReader reader(sound.path());
        const auto& first =
            reader.contents().blocks.at(0); // info reads the first and the last chunk of each topic
        bytes[first.offset + first.length - 1] ^= std::byte{1};
    }
    check_loss(tandem_program({"bag", "info", TemporaryFile(bytes).path()}), "does not match its CRC-32");
}

TEST_CASE("tandem bag convert names the format that is missing") {
    const TemporaryFile file(ten_numbers());
    const auto result = tandem_program({"bag", "convert", file.path()});
    check_loss(result, "the format is missing: add --json");
    CHECK_THAT(result.errors, !Catch::Contains("command is missing"));
}

namespace {

/// Runs tandem with a limit for the size of files. Returns the exit code.
int process_with_file_limit(std::vector<std::string> arguments, rlim_t bytes) {
    arguments.insert(arguments.begin(), TANDEM_PROGRAM);
    std::vector<char*> words;
    for (auto& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    tandem::shm::test::Child child([&] {
        const rlimit limit{bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
        execv(TANDEM_PROGRAM, words.data());
        return 98;
    });
    return child.wait();
}

} // namespace

TEST_CASE("tandem bag cut leaves no part of a file when it fails") {
    const TemporaryFile file(ten_seconds());
    const BagFolder folder;
    const auto out = folder.file("part.mcap");
    const auto failed = process_with_file_limit({"bag", "cut", file.path(), "-o", out}, 1000);
    CHECK(failed == 1);
    CHECK(std::filesystem::is_empty(folder.path));
}

TEST_CASE("tandem bag convert refuses to overwrite a recording") {
    const BagFolder folder;
    const auto file = folder.file("run.mcap"), other = folder.file("other.mcap"),
               text = folder.file("run.json");
    {
        FileSink sink(file);
        McapWriter writer(sink, {.library = "test"});
        const auto port = writer.add_channel("speed", 0, "cdr", {{"tandem.signature", "d"}});
        const std::string zero("\0\1\0\0\0\0\0\0\0\0\0\0", 12);
        writer.write(port, 1, 1, 1, tandem::test::bytes_of(zero));
        writer.close();
        sink.close();
    }
    std::filesystem::copy_file(file, other);
    for (const auto& out : {file, other}) {
        const auto refused = tandem_program({"bag", "convert", "--json", file, "-o", out});
        CHECK(refused.exit_code == 1);
        CHECK(refused.errors == "tandem: " + out + " is a recording: give another output file\n");
        CHECK(tandem_program({"bag", "check", out}).exit_code == 0);
    }
    for (int i = 0; i < 2; ++i)
        CHECK(tandem_program({"bag", "convert", "--json", file, "-o", text}).exit_code == 0);
    const auto cut = tandem_program({"bag", "cut", file, "-o", other});
    CHECK(cut.exit_code == 1);
    CHECK(tandem_program({"bag", "check", other}).exit_code == 0);
}

TEST_CASE("times of a recording are seconds from its start or RFC 3339 timestamps") {
    constexpr std::uint64_t begin = 5'000'000'000;
    CHECK(parse_time("0", begin, "--from") == begin);
    CHECK(parse_time("1.25", begin, "--from") == 6'250'000'000);
    CHECK(parse_time("18000000000", begin, "--from") == 18'000'000'005'000'000'000U);
    CHECK(parse_time("1970-01-01T00:00:01.5Z", begin, "--from") == 1'500'000'000);
    CHECK(parse_time("1970-01-01t09:00:01+09:00", begin, "--from") == 1'000'000'000);
    for (const char* wrong : {"", "-1", "1e3", "999999999999", "1970-02-31T00:00:00Z", "1970-01-01T00:00:00",
                              "1970-01-01T00:00:00+01:00", "9999-01-01T00:00:00Z", "1970-01-01T25:00:00Z"}) {
        CAPTURE(wrong);
        CHECK_THROWS_WITH(parse_time(wrong, begin, "--to"),
                          Catch::Contains("--to " + std::string(wrong) + " is not a valid time"));
    }
    CHECK(format_time(1'500'000'000) == "1.500000000 s");
    CHECK(parse_time(format_time(1'795'420'800'123'456'789), 0, "") == 1'795'420'800'123'456'789);
}

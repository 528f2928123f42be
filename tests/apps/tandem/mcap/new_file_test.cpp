// SPDX-License-Identifier: Apache-2.0
// Files of recordings: they replace no file, have one writer, and end cleanly when there is no more room.
#include "apps/tandem/mcap/check_file.hpp"
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/mcap/writer.hpp"
#include "tests/apps/tandem/mcap/memory_sink.hpp"

#include <catch2/catch.hpp>

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace tandem::mcap;
using tandem::test::bytes_of;
namespace fs = std::filesystem;

namespace {

struct Folder {
    Folder() {
        std::string name = (fs::temp_directory_path() / "tandem-new-file-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path); }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {}));
    }
    fs::path path;
};

std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A file system with few free bytes: what does not fit fails, and what has been reserved does not.
struct FullSink : tandem::test::MemorySink {
    bool truncate(std::uint64_t size) override {
        bytes.resize(size);
        return true;
    }
    void reserve(std::uint64_t size) override {
        if (reserves && size > room - bytes.size()) throw Error("no room");
    }
    bool reserves = true;
};

/// Writes messages of 100 bytes, ten per chunk, until there is no more room. Returns the content of the file.
McapWriter::Rest fill(FullSink& sink) {
    McapWriter writer(sink, {.library = "test", .chunk_size = 1300});
    const auto channel = writer.add_channel("topic", 0, "cdr");
    try {
        for (std::uint32_t i = 0; i < 1'000'000; ++i)
            writer.write(channel, i, i, i, bytes_of(std::string(100, 'a')));
    } catch (const Error&) {
        return writer.end_at_last_chunk();
    }
    FAIL("there is always room");
    return {};
}

void write_to(const fs::path& file, const Bytes& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

TEST_CASE("a new file has its name at once, the mode of the user, and nothing beside it") {
    const Folder folder;
    const mode_t mask = umask(027);
    {
        FileSink sink(folder.path / "run.mcap");
        sink.write(bytes_of("abc"));
        CHECK(folder.files() == 1);
        CHECK((fs::status(folder.path / "run.mcap").permissions() & fs::perms::mask) == fs::perms{0640});
        sink.close();
    }
    umask(mask);
    CHECK(content_of(folder.path / "run.mcap") == "abc");
    CHECK(folder.files() == 1);
}

TEST_CASE("a file that can be recreated gets its name only when it is complete") {
    const Folder folder;
    {
        FileSink sink(folder.path / "part.mcap", NewFile::Named::when_complete);
        sink.write(bytes_of("abc"));
        sink.flush();
        CHECK_FALSE(fs::exists(folder.path / "part.mcap"));
    }
    CHECK(folder.files() == 0); // an exception ended it
    FileSink sink(folder.path / "part.mcap", NewFile::Named::when_complete);
    sink.write(bytes_of("abc"));
    sink.close();
    CHECK(content_of(folder.path / "part.mcap") == "abc");
    CHECK(folder.files() == 1);
}

TEST_CASE("a second writer of a file is refused, and the first one continues") {
    const Folder folder;
    const auto file = folder.path / "run.mcap";
    const std::string in_use = file.string() + " is being written by another program: give another file";
    const bool empty = GENERATE(false, true); // an empty file may exist, as from mktemp
    if (empty) std::ofstream(file).close();
    FileSink first(file);
    CHECK_THROWS_WITH(FileSink(file), in_use);
    first.write(bytes_of("abc"));
    first.flush();
    CHECK_THROWS_WITH(FileSink(file), in_use);
    first.close();
    CHECK_THROWS_WITH(FileSink(file),
                      file.string() + " already exists and is not empty: give another file, or remove it");
    CHECK(content_of(file) == "abc");
    CHECK(folder.files() == 1);
}

TEST_CASE("a file that another program creates under the same name is not replaced") {
    const Folder folder;
    const auto file = folder.path / "part.mcap";
    FileSink sink(file, NewFile::Named::when_complete);
    sink.write(bytes_of("abc"));
    std::ofstream(file) << "another one";
    CHECK_THROWS_WITH(sink.close(), Catch::Contains("already exists"));
    CHECK(content_of(file) == "another one");
}

TEST_CASE("a file is not created through a symbolic link") {
    const Folder folder;
    fs::create_symlink(folder.path / "elsewhere", folder.path / "run.mcap");
    CHECK_THROWS_WITH(FileSink(folder.path / "run.mcap"), Catch::Contains("already exists"));
    CHECK(folder.files() == 1);
}

TEST_CASE("a discarded file is gone, and one that existed is empty again") {
    const Folder folder;
    std::ofstream(folder.path / "old").close();
    for (const char* name : {"old", "new"}) {
        FileSink sink(folder.path / name);
        sink.write(bytes_of("abc"));
        sink.flush();
        sink.discard();
    }
    CHECK(fs::file_size(folder.path / "old") == 0);
    CHECK(folder.files() == 1);
}

TEST_CASE("flushed data go to the disk without a call of the writer's thread") {
    const Folder folder;
    const int descriptor = ::open((folder.path / "x").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    {
        DiskSync disk(descriptor);
        for (int i = 0; i < 1000; ++i) CHECK(disk.request() == 0);
        CHECK(disk.stop() == 0);
    }
    ::close(descriptor);
    CHECK(sync_to_disk(descriptor) == EBADF);
    DiskSync closed(descriptor);
    int error = 0;
    for (int i = 0; i < 2000 && error == 0; ++i) {
        error = closed.request();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(error == EBADF); // the failure of the thread reaches the writer
}

TEST_CASE("a writer without room closes its file at the last chunk") {
    const Folder folder;
    for (std::size_t room = 3000; room < 6000; room += 37) {
        INFO(room << " bytes");
        FullSink sink;
        sink.room = room;
        const auto rest = fill(sink);
        CHECK(rest.closed);
        CHECK(rest.lost_messages > 0);
        write_to(folder.path / "run.mcap", sink.bytes);
        for (const auto& finding : check_file(folder.path / "run.mcap")) FAIL(finding.line);
        McapReader reader(folder.path / "run.mcap");
        CHECK(reader.contents().complete);
        CHECK(reader.contents().statistics.message_count == rest.messages);
        CHECK(rest.messages > 0);
    }
}

TEST_CASE("a writer without room for the end leaves whole records") {
    const Folder folder;
    for (std::size_t room = 3000; room < 6000; room += 37) {
        INFO(room << " bytes");
        FullSink sink;
        sink.room = room;
        sink.reserves = false; // as a file system without fallocate(2)
        const auto rest = fill(sink);
        write_to(folder.path / "run.mcap", sink.bytes);
        McapReader reader(folder.path / "run.mcap");
        CHECK(reader.contents().complete == rest.closed);
        CHECK(reader.contents().statistics.message_count == rest.messages);
        CHECK(reader.contents().problems.size() == (rest.closed ? 0U : 1U));
    }
}

TEST_CASE("attachments and metadata after the last chunk are dropped when there is no room") {
    FullSink sink;
    McapWriter writer(sink, {.library = "test"});
    const auto channel = writer.add_channel("topic", 0, "cdr");
    writer.write(channel, 1, 1, 1, bytes_of("a"));
    writer.flush();
    writer.add_metadata("late", {{"key", "value"}});
    sink.room = sink.bytes.size() + 2000;
    CHECK_THROWS_AS(writer.attach("big", "text/plain", 0, 0, bytes_of(std::string(3000, 'a'))), Error);
    const auto rest = writer.end_at_last_chunk();
    CHECK(rest.closed);
    CHECK(rest.messages == 1);
    CHECK(rest.lost_messages == 0);
    const Folder folder;
    write_to(folder.path / "run.mcap", sink.bytes);
    for (const auto& finding : check_file(folder.path / "run.mcap")) FAIL(finding.line);
}

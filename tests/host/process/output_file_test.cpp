// SPDX-License-Identifier: Apache-2.0
// Opens files for writing in folders where another user may have placed something else under the name.
#include "host/process/output_file.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

using namespace tandem::process;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

struct Folder {
    Folder() {
        std::string name = (fs::temp_directory_path() / "tandem-output-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    /// Any user may now write to it, as to /tmp.
    void share() const { chmod(path.c_str(), 01777); }
    fs::path path;
};

std::string content(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("an output file is created, replaced or appended to") {
    const Folder folder;
    const fs::path file = folder.path / "out";
    write_output(file, "a longer text");
    write_output(file, "text");
    CHECK(content(file) == "text");
    const auto appended = open_output(file, Existing::append);
    REQUIRE(write(appended.get(), "s", 1) == 1);
    CHECK(content(file) == "texts");
    open_output(file, Existing::keep);
    CHECK(content(file) == "texts");
    open_output(folder.path / "private", Existing::replace, 0600);
    CHECK((fs::status(folder.path / "private").permissions() & fs::perms::others_all) == fs::perms::none);
    write_output("/dev/null", "text");
}

TEST_CASE("a failed output names the file and the reason") {
    const Folder folder;
    CHECK_THROWS_WITH(write_output(folder.path / "absent" / "out", "text"),
                      Contains("absent/out cannot be written: No such file or directory"));
    CHECK_THROWS_WITH(write_output(folder.path, "text"), Contains("cannot be written: Is a directory"));
    CHECK_THROWS_WITH(write_output("/dev/full", "text"),
                      Contains("/dev/full cannot be written: No space left on device"));
}

TEST_CASE("a link of the same user is followed, even in a shared folder") {
    const Folder folder;
    fs::create_symlink("target", folder.path / "link");
    write_output(folder.path / "link", "private");
    CHECK(content(folder.path / "target") == "private");
    folder.share();
    write_output(folder.path / "link", "shared");
    CHECK(content(folder.path / "target") == "shared");
}

TEST_CASE("files and links of another user in a shared folder are refused and stay unchanged") {
    if (geteuid() != 0) TANDEM_SKIP("only root can create what belongs to another user");
    const Folder folder;
    const uid_t nobody = 65534;
    std::ofstream(folder.path / "file") << "theirs";
    std::ofstream(folder.path / "secret") << "ours";
    fs::create_symlink("secret", folder.path / "link");
    fs::create_symlink("file", folder.path / "own link");
    REQUIRE(mkfifo((folder.path / "fifo").c_str(), 0666) == 0);
    for (const char* name : {"file", "link", "fifo"})
        REQUIRE(lchown((folder.path / name).c_str(), nobody, nobody) == 0);
    folder.share();
    for (const char* name : {"file", "link", "fifo", "own link"})
        CHECK_THROWS_WITH(write_output(folder.path / name, "text"),
                          Contains(std::string(name) + " cannot be written") && Contains("another user"));
    CHECK(content(folder.path / "file") == "theirs");
    CHECK(content(folder.path / "secret") == "ours");
    chmod(folder.path.c_str(), 0755); // a folder of one user: the user decides
    write_output(folder.path / "file", "text");
    CHECK(content(folder.path / "file") == "text");
}

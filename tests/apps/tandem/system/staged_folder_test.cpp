// SPDX-License-Identifier: Apache-2.0
// A system gets its folder as a whole: a command that is killed leaves nothing that a later one refuses.
#include "apps/tandem/system/staged_folder.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

using namespace tandem::command;
namespace fs = std::filesystem;

namespace {

struct Folder {
    Folder() {
        std::string name = (fs::temp_directory_path() / "tandem-staged-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    /// The files below the folder, with their texts.
    std::set<std::string> files() const {
        std::set<std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(path))
            if (entry.is_regular_file())
                found.insert(entry.path().lexically_relative(path).string() + ": " + text(entry.path()));
        return found;
    }
    static std::string text(const fs::path& file) {
        std::ifstream stream(file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    fs::path path;
};

void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

/// Runs a part of a command in another process. The part ends it by _exit(0): no destructor runs, as after SIGKILL.
void run_and_kill(const std::function<void()>& part) {
    const pid_t child = fork();
    if (child == 0) {
        part();
        _exit(1);
    }
    int status = 1;
    waitpid(child, &status, 0);
    REQUIRE(status == 0);
}

} // namespace

TEST_CASE("a new system appears only as a whole, even if the command was killed") {
    const Folder folder;
    const fs::path robot = folder.path / "robot";
    run_and_kill([&] {
        StagedFolder staged(robot);
        write(staged.add_side("rtm") / "rtc.conf", "half");
        write(staged.path() / "other", "half");
        _exit(0);
    });
    REQUIRE(folder.files().size() == 2);
    CHECK(!fs::exists(robot));
    StagedFolder staged(robot / ""); // the slash of a completed name
    write(staged.add_side("rtm") / "rtc.conf", "new");
    write(staged.add_side("opros") / "robot.xml", "new");
    CHECK(!fs::exists(robot));
    staged.publish();
    CHECK(folder.files() == std::set<std::string>{"robot/rtm/rtc.conf: new", "robot/opros/robot.xml: new"});
}

TEST_CASE("a system is added to a folder with other files, and to none with the same side") {
    const Folder folder;
    write(folder.path / "run.log", "log");
    write(folder.path / "opros/a.xml", "old");
    fs::create_directories(folder.path / "rtm"); // an empty folder is not a side
    {
        StagedFolder staged(folder.path);
        CHECK_THROWS_WITH(staged.add_side("opros"),
                          Catch::Contains("opros exists and is not empty; remove it"));
        write(staged.add_side("rtm") / "rtc.conf", "new");
        staged.publish();
    }
    CHECK(folder.files() == std::set<std::string>{"run.log: log", "opros/a.xml: old", "rtm/rtc.conf: new"});
}

TEST_CASE("a command that fails leaves nothing, and two commands do not write the same folder") {
    const Folder folder;
    {
        StagedFolder staged(folder.path / "robot");
        write(staged.add_side("rtm") / "rtc.conf", "half");
        CHECK_THROWS_WITH(StagedFolder(folder.path / "robot"),
                          Catch::EndsWith("robot is being written by another command; try again later"));
    }
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("a link in the place of the new folder is not followed, and what it leads to is kept") {
    const Folder folder;
    write(folder.path / "data/file", "mine");
    fs::create_symlink(folder.path / "data", folder.path / ".robot.tandem-new");
    CHECK_THROWS_WITH(StagedFolder(folder.path / "robot"),
                      Catch::EndsWith(".robot.tandem-new is not a folder of this user; remove it"));
    CHECK(fs::exists(folder.path / "data/file"));
}

TEST_CASE("files of a running system are replaced one by one, and the former ones are kept") {
    const Folder folder;
    for (const char* name : {"rtm/rtc.conf", "rtm/Arm.conf"}) write(folder.path / name, "old");
    write(folder.path / "rtm/rtc.conf~", "older");
    fs::permissions(folder.path / "rtm/rtc.conf", fs::perms::owner_read | fs::perms::owner_write);
    {
        StagedFolder staged(folder.path);
        for (const char* name : {"rtm/rtc.conf", "rtm/New.conf"}) write(staged.path() / name, "new");
        write(staged.path() / "rtm/Arm.conf", "old");
        staged.publish_files();
    }
    CHECK(folder.files() == std::set<std::string>{"rtm/rtc.conf: new", "rtm/rtc.conf~: old",
                                                  "rtm/New.conf: new", "rtm/Arm.conf: old"});
    CHECK(fs::status(folder.path / "rtm/rtc.conf").permissions() ==
          (fs::perms::owner_read | fs::perms::owner_write));
}

// SPDX-License-Identifier: Apache-2.0
// The installed tree, moved after its installation, as a user without the source tree uses it.
#include "program.hpp"
#include "shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

using tandem::test::shell;

namespace {
void run(const std::string& command) {
    const auto said = shell("timeout 250 " + command);
    INFO(command << "\n" << said.output);
    REQUIRE(said.exit_code == 0);
}
} // namespace

TEST_CASE("an installed tree that was moved builds components by find_package and by its own command") {
    const Folder folder;
    const std::string moved = folder.path() / "moved", bin = moved + "/bin/", arm = folder.path() / "Arm";
    run("cmake --install " BUILD_TREE " --strip --component opros --prefix " +
        (folder.path() / "first").string());
    std::filesystem::rename(folder.path() / "first", moved);
    CHECK(std::filesystem::exists(moved + "/share/doc/tandem/docs/tutorial.md"));
    run(bin + "tandem opros new Arm --in " + folder.path().string());

    run("cmake -S " + arm + " -B " + arm + "/build -DCMAKE_PREFIX_PATH=" + moved);
    run("cmake --build " + arm + "/build");
    const auto by_package = tandem::test::run_host(bin + "opros_host", arm + "/build/ArmApp.xml");
    INFO(by_package.output);
    CHECK(by_package.exit_code == 0);
    CHECK_THAT(by_package.output, Catch::Contains("Arm: started, gain 2"));

    run(bin + "tandem opros build " + arm);
    const auto by_command = tandem::test::run_host(bin + "opros_host", arm + "/ArmApp.xml");
    INFO(by_command.output);
    CHECK(by_command.exit_code == 0);
    CHECK_THAT(by_command.output, Catch::Contains("Arm: started, gain 2"));
    run(bin + "tandem opros check " + arm + "/ArmApp.xml");
    // No file of the installation knows where it was built or first installed.
    CHECK(shell("grep -rl " + (folder.path() / "first").string() + " " + moved).output.empty());
    CHECK(shell("grep -rl " BUILD_TREE " " + moved + "/lib").output.empty());
}

TEST_CASE("a package component that Tandem does not have is refused by name") {
    const Folder folder;
    folder.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.16)\nproject(x CXX)\n"
                                   "find_package(Tandem REQUIRED COMPONENTS wings)\n");
    const auto said =
        shell("cmake -S " + folder.path().string() + " -B " + (folder.path() / "build").string() +
              " -DTandem_DIR=" BUILD_TREE "/lib/cmake/Tandem");
    CHECK(said.exit_code != 0);
    CHECK_THAT(said.output, Catch::Contains("no component") && Catch::Contains("wings"));
}

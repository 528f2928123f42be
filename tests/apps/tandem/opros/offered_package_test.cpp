// SPDX-License-Identifier: Apache-2.0
// `tandem opros build` in a terminal, with programs that stand in for apt-get and sudo.
#include "host/process/file_descriptor.hpp"
#include "tests/apps/tandem/opros/old_component.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {

struct InTerminal {
    int exit_code;
    std::string output;
};

/// Builds the component in a terminal where someone types the answer. The compiler also searches `headers` of the folder, and
/// programs in its `programs` come first.
InTerminal build_in_terminal(const fs::path& folder, const std::string& answer) {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    REQUIRE(child >= 0);
    if (child == 0) {
        setenv("PATH", ((folder / "programs").string() + ":" + getenv("PATH")).c_str(), 1);
        setenv("CPATH", (folder / "headers").c_str(), 1);
        execl(TANDEM_PROGRAM, "tandem", "opros", "build", (folder / "Old").c_str(), nullptr);
        _exit(127);
    }
    const tandem::process::FileDescriptor owner(terminal);
    CHECK(write(terminal, answer.data(), answer.size()) == static_cast<ssize_t>(answer.size()));
    std::string output;
    char buffer[4096];
    for (ssize_t size; (size = read(terminal, buffer, sizeof buffer)) > 0;)
        output.append(buffer, static_cast<std::size_t>(size));
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

void write_program(const Folder& folder, const std::string& name, const std::string& commands) {
    const auto file = "programs/" + name;
    folder.write(file, "#!/bin/sh\n" + commands);
    fs::permissions(folder.path() / file, fs::perms::owner_all);
}

} // namespace

TEST_CASE(
    "in a terminal, tandem build offers to install the package that a component lacks, and then continues") {
    const Folder folder;
    tandem::test::old_component(folder, "");
    folder.write("Old/Gain.h", "#include <miniupnpc/miniupnpc.h>\n");
    write_program(folder, "sudo", "exec \"$@\"\n");
    write_program(folder, "apt-get",
                  "cd '" + folder.path().string() +
                      "'\necho \"$@\" >> calls\nmkdir -p headers/miniupnpc\n"
                      "echo 'inline double gain() { return 5; }' > headers/miniupnpc/miniupnpc.h\n");

    const auto refused = build_in_terminal(folder.path(), "\n");
    INFO(refused.output);
    CHECK(refused.exit_code == 1);
    CHECK_THAT(
        refused.output,
        Catch::Contains("tandem: the Debian package libminiupnpc-dev is not installed; install it now") &&
            Catch::Contains("apt-get install)? [y/N] ") &&
            Catch::Contains("; apt install libminiupnpc-dev ("));
    CHECK_FALSE(fs::exists(folder.path() / "calls"));

    const auto accepted = build_in_terminal(folder.path(), "y\n");
    INFO(accepted.output);
    CHECK(accepted.exit_code == 0);
    std::string call;
    std::getline(std::ifstream(folder.path() / "calls"), call);
    CHECK(call == "install --yes --no-remove libminiupnpc-dev");
    CHECK(fs::exists(folder.path() / "Old/profile/Old.so"));
}

TEST_CASE("a package that apt-get cannot install is named in the last line") {
    const Folder folder;
    tandem::test::old_component(folder, "");
    folder.write("Old/Gain.h", "#include <miniupnpc/miniupnpc.h>\n");
    write_program(folder, "sudo", "exec \"$@\"\n");
    write_program(folder, "apt-get", "touch '" + folder.path().string() + "/calls'\nexit 100\n");
    const auto failed = build_in_terminal(folder.path(), "y\n");
    INFO(failed.output);
    CHECK(failed.exit_code == 1);
    CHECK(fs::exists(folder.path() / "calls"));
    CHECK_THAT(failed.output.substr(failed.output.rfind("tandem: ")),
               Catch::Contains("; apt install libminiupnpc-dev ("));
}

// SPDX-License-Identifier: Apache-2.0
// The top of the command line: --version, doctor, and completion in bash.
#include "program.hpp"

#include "host/process/run_command.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tandem_version.hpp>

namespace shm = tandem::shm;
using tandem::test::Result;
using tandem::test::tandem_program;

namespace {

/// Runs a script in a bash that has read the completion script which was built with the program.
std::string in_bash(const std::string& script) {
    const std::string commands = "source " COMPLETION_FILE "; " + script;
    return tandem::process::run_command({"bash", "--norc", "-c", commands}, {.merge_errors = true}).output;
}

/// Returns the words that bash offers when TAB is pressed after these words; the last one may be incomplete
/// or "".
std::string completions(const std::vector<std::string>& words) {
    std::string list;
    for (const auto& word : words) list += " \"" + word + "\"";
    return in_bash("COMP_WORDS=(" + list + "); COMP_CWORD=" + std::to_string(words.size() - 1) +
                   "; _tandem; echo ${COMPREPLY[*]}");
}

} // namespace

TEST_CASE("the option for hosts in the help of tandem run exists in both hosts") {
    const auto help = tandem_program({"run", "--help"}).output;
    const std::string begin = "--host-option=";
    const auto at = help.find(begin);
    REQUIRE(at != std::string::npos);
    const std::string option =
        help.substr(at + begin.size(), help.find_first_of(" \n", at) - at - begin.size());
    CAPTURE(option);
    for (const std::string host : {"opros_host", "rtm_host"}) {
        const auto help_of_host = tandem::process::run_command({BUILD_TREE "/bin/" + host, "--help"}).output;
        CHECK_THAT(help_of_host, Catch::Contains(option + " "));
    }
}

TEST_CASE("the usage of tandem rtm disconnect shows one port or two") {
    const Result help = tandem_program({"rtm", "disconnect", "--help"});
    CHECK_THAT(help.output, Catch::Contains("tandem rtm disconnect [OPTIONS] PORT [OTHER]\n"));
    for (const std::vector<std::string>& ports :
         std::vector<std::vector<std::string>>{{}, {"A:a", "B:b", "C:c"}}) {
        std::vector<std::string> arguments{"rtm", "disconnect"};
        arguments.insert(arguments.end(), ports.begin(), ports.end());
        const Result refused = tandem_program(arguments);
        CHECK(refused.exit_code != 0);
        CHECK_THAT(refused.errors, Catch::Contains(ports.empty() ? "PORT is required" : "C:c"));
    }
}

TEST_CASE("the help of a command for running components explains COMPONENT only if the command takes one") {
    for (const std::string model : {"opros", "rtm"}) {
        std::size_t explained = 0;
        for (const std::string command :
             {"list", "tree", "info", "conf", "start", "activate", "connect", "cat"}) {
            const Result help = tandem_program({model, command, "--help"});
            const bool explains = help.output_contains("\nCOMPONENT is ");
            INFO(model << " " << command);
            explained += explains;
            if (command == "list" || command == "tree") CHECK_FALSE(explains);
        }
        CHECK(explained >= 2);
    }
}

TEST_CASE("tandem --version prints the version of the build") {
    const Result result = tandem_program({"--version"});
    CHECK(result.exit_code == 0);
    CHECK(result.output == std::string("tandem ") + tandem::version + "\n");
}

TEST_CASE("tandem doctor ends with exit code 1 if and only if a check is an error") {
    const Result result = tandem_program({"doctor", "--json"});
    const auto json = result.json();
    bool any_error = false;
    for (const auto& check : json["checks"]) {
        any_error = any_error || check["status"] == "error";
        CHECK(check.contains("advice") == (check["status"] != "ok"));
    }
    CHECK(json["checks"].size() >= 24); // one or more of what is open
    CHECK(result.exit_code == (any_error ? 1 : 0));
    CHECK(tandem_program({"doctor"}).output_contains("/dev/shm mount"));
}

TEST_CASE("No option of tandem accepts nan as a number") {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"record", "link", "-o", "out.mcap", "--duration"},
                                               {"run", ".", "--lockstep", "--duration"},
                                               {"run", ".", "--wait"},
                                               {"run", ".", "--grace"},
                                               {"top", "--period"},
                                               {"echo", "link", "--timeout"},
                                               {"hz", "link", "--period"},
                                               {"shm", "stats", "link", "--watch"},
                                               {"opros", "list", "--timeout"},
                                               {"rtm", "list", "--timeout"},
                                               {"rtm", "cat", "a:b", "--for"},
                                               {"rtm", "inject", "a:b", "1", "--rate"},
                                               {"opros", "build", ".", "--timeout"},
                                               {"replay", "run.mcap", "--rate"}}) {
        auto arguments = words;
        arguments.push_back("nan");
        const Result result = tandem_program(arguments);
        CHECK(result.exit_code != 0);
        CHECK_THAT(result.errors, Catch::Contains(words.back() + ": Value nan"));
    }
    CHECK_FALSE(std::filesystem::exists("out.mcap"));
}

TEST_CASE("the installed completion script is what tandem completion bash prints") {
    std::ifstream file(COMPLETION_FILE);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    CHECK(text == tandem_program({"completion", "bash"}).output);
    CHECK(tandem_program({"completion", "tcsh"}).exit_code != 0);
}

TEST_CASE("bash completes sub-commands and options of tandem") {
    CHECK(completions({"tandem", "rt"}) == "rtm\n");
    CHECK(completions({"tandem", ""}) == "doctor opros rtm idl2opros opros2idl link run system shm echo hz "
                                         "top graph record replay bag monitor completion\n");
    CHECK(completions({"tandem", "shm", "st"}) == "stats\n");
    CHECK(completions({"tandem", "--v"}) == "--version\n");
    const std::string stats = completions({"tandem", "shm", "stats", "--"});
    for (const char* option : {"--help", "--generation", "--json", "--watch", "--count"})
        CHECK_THAT(stats, Catch::Contains(option));
    CHECK(completions({"tandem", "shm", "stats", "link", "--wa"}) == "--watch\n");
    CHECK(completions({"tandem", "opros", "--js"}) == "\n");
}

TEST_CASE("bash completes the values of options of tandem") {
    CHECK(completions({"tandem", "completion", ""}) == "bash\n");
    CHECK(completions({"tandem", "rtm", "build", "--standard", "1"}) == "11 14 17\n");
    CHECK(completions({"tandem", "rtm", "build", "--standard", "=", "2"}) == "20\n");
    // A value that looks like a sub-command is one only where sub-commands stand.
    CHECK(completions({"tandem", "rtm", "build", "--timeout", "opros", "--outp"}) == "--output\n");
    CHECK(completions({"tandem", "shm", "stats", "--watch", ""}) == "\n");
}

TEST_CASE("bash completes the names of links, without executing the names of other files") {
    const shm::test::Link link;
    const auto first = shm::test::join(link, shm::Side::first);
    const std::string hostile = "/dev/shm/tandem.$(touch completed-" + link.name + ").1";
    std::ofstream(hostile).close();
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"tandem", "record", link.name.substr(0, link.name.size() - 1)},
             {"tandem", "top", link.name},
             {"tandem", "shm", "stats", link.name},
             {"tandem", "replay", "run.mcap", "--link", link.name}})
        CHECK(completions(words) == link.name + "\n");
    CHECK_FALSE(std::filesystem::exists("completed-" + link.name));
    std::filesystem::remove(hostile);
}

TEST_CASE("bash completes the names of running components, without executing them") {
    // Instead of the program, so that no component has to run.
    const std::string program = "tandem() { echo $* >> asked; echo NAME TYPE STATE; echo Arm Motor ACTIVE; "
                                "echo Adaptor AdaptorComp READY; echo \\$\\(touch\\${IFS}completed\\) X; "
                                "echo - - UNREACHABLE; }; ";
    const auto offered = [&](const std::string& words) {
        return in_bash("cd $(mktemp -d); " + program + "COMP_WORDS=(" + words +
                       "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _tandem; echo ${COMPREPLY[*]}; cat asked; "
                       "ls completed 2>/dev/null");
    };
    CHECK(offered("tandem opros conf A") == "Arm Adaptor\nopros list --timeout 1\n");
    CHECK(offered("tandem opros recover \"\"") == "Arm Adaptor\nopros list --timeout 1\n");
    CHECK(offered("tandem rtm activate Ar") == "Arm\nrtm list --timeout 1\n");
}

TEST_CASE("bash completes files and folders where tandem expects them") {
    const std::string folder =
        in_bash("cd $(mktemp -d); mkdir \"a folder\"; touch \"a file\"; COMP_CWORD=3; "
                "COMP_WORDS=(tandem opros info a); _tandem; printf \"%s;\" \"${COMPREPLY[@]}\"; "
                "COMP_WORDS=(tandem opros build a); _tandem; printf \"%s;\" \"${COMPREPLY[@]}\"; "
                "COMP_CWORD=4; COMP_WORDS=(tandem opros build --output a); _tandem; "
                "printf \"%s;\" \"${COMPREPLY[@]}\"");
    CHECK_THAT(folder, Catch::Contains("a file;") && Catch::EndsWith("a folder;a folder;"));
}

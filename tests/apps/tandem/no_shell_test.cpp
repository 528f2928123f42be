// SPDX-License-Identifier: Apache-2.0
// No name of a file or folder is executed as a command: the programs run with names that a shell, CMake, make, gnuplot or a
// terminal would interpret. Each run works, or fails with one line.
#include "host/process/run_command.hpp"
#include "tests/host/opros/engine/folder.hpp"
#include "tests/support/nasty_names.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;
using tandem::process::CommandResult;

const std::string tandem_program = TANDEM_PROGRAM;

const char* const profile = "<component_profile><name>Part</name><execution_environment><library_name>Part.so"
                            "</library_name></execution_environment><execution_semantics><type>passive</type>"
                            "</execution_semantics></component_profile>\n";

/// A working folder for commands, with files and folders that have the given name.
struct NameFolder : Folder {
    CommandResult run(const Command& command) const {
        return tandem::process::run_command(command, {.folder = path().string()});
    }
    bool was_attacked() const {
        const auto all = fs::recursive_directory_iterator(path());
        return std::any_of(begin(all), end(all),
                           [](const auto& entry) { return entry.path().filename() == "marker"; });
    }
};

/// Writes what the commands read: a folder of the name, and files of the name in it and beside it.
void write_inputs(const NameFolder& folder, const std::string& name) {
    folder.write("Arm.idl", "interface Arm { void stop(); };\n");
    folder.write(name + "/part.idl", "interface Part { void stop(); };\n");
    folder.write(name + ".idl", "interface Arm { void stop(); };\n");
    folder.write(name + ".xml", profile);
    folder.write(name + ".service.xml",
                 "<service_port_type_profile><service_port_type><type_name>Arm</type_name>\n"
                 "<method name=\"stop\" return_type=\"void\" call_type=\"blocking\"/>\n"
                 "</service_port_type></service_port_type_profile>\n");
    folder.write(name + ".conf", "naming.enable: NO\nmanager.modules.preload: absent.so\n");
    folder.write(name + ".mcap", "no recording");
    folder.write(name + ".csv", "t,jx,jy,estop\n0,0,0,0\n");
    folder.write(name + ".profile/part.xml", profile);
}

/// The commands that take a name of a file or folder.
std::vector<Command> commands_with(const std::string& name) {
    const std::string path = "./" + name;
    std::vector<Command> commands{
        {"idl2opros", path + ".idl", "-o", path + ".out"},
        {"idl2opros", "Arm.idl", "-I" + path, "-o", path},
        {"opros2idl", path + ".service.xml"},
        {"opros2idl", path + ".service.xml", "--output", path + ".made.idl"},
        {"opros", "check", path + ".xml"},
        {"opros", "check", "--plugin-path", path, path + ".profile"},
        {"opros", "info", path + ".xml"},
        {"opros", "build", path},
        {"opros", "build", path + ".profile", "--build-dir", path + ".build", "-I", path},
        {"opros", "new", name},
        {"opros", "import", path, "-o", path + ".imported"},
        {"rtm", "build", path, "--output", path},
        {"rtm", "new", name},
        {"rtm", "import", path, "-o", path + ".imported"},
        {"run", path},
        {"link", "check", path},
        {"link", "profile", path, path + ".profile", "-o", path + ".linked"},
        {"bag", "info", path + ".mcap"},
        {"bag", "check", path + ".mcap"},
        {"bag", "cut", path + ".mcap", "-o", path + ".cut.mcap"},
        {"bag", "convert", path + ".mcap", "--json", "-o", path + ".json"},
        {"replay", path + ".mcap"},
        {"record", "--output", path + ".recorded.mcap", "--duration", "0.05", "--", name},
        {"graph", "--", name},
        {"graph", "--dot", "--", name},
        {"shm", "info", "--", name},
        {"shm", "stats", "--", name},
    };
    for (auto& command : commands) command.insert(command.begin(), tandem_program);
    commands.push_back({OPROS_HOST, path + ".xml"});
    commands.push_back({RTM_HOST, "-f", path + ".conf"});
    commands.push_back({WHEELCHAIR_PROGRAM, "--config", "memory", "--duration", "0.1", "--joystick",
                        path + ".csv", "--csv", path + ".made.csv", "--json", path + ".made.json", "--plot",
                        path + ".svg"});
    return commands;
}

bool has_control_characters(const std::string& text) {
    return std::any_of(text.begin(), text.end(),
                       [](unsigned char c) { return (c < ' ' && c != '\n' && c != '\t') || c == 0x7f; }) ||
           text.find("\xc2\x9b") != std::string::npos;
}

/// The lines without the note of `tandem record` that it waits for a link.
std::string without_notes(const std::string& errors) {
    std::istringstream text(errors);
    std::string kept;
    for (std::string line; std::getline(text, line);)
        if (line.rfind("tandem: waiting for link ", 0) != 0) kept += line + "\n";
    return kept;
}

/// A program may log before it fails; `tandem` does not. Checks print their findings on standard output.
void check_result(const Command& command, const CommandResult& result) {
    INFO(command[0] << " " << command[1] << " ... : " << result.output << result.errors);
    CHECK_FALSE(result.timed_out);
    CHECK_FALSE(result.status.signalled);
    CHECK_FALSE(has_control_characters(result.errors));
    CHECK_FALSE(has_control_characters(result.output));
    if (result.succeeded() || command[0] != tandem_program) return;
    const std::string errors = without_notes(result.errors);
    CHECK(std::count(errors.begin(), errors.end(), '\n') <= 1);
    CHECK_FALSE((result.errors + result.output).empty());
}

} // namespace

// Three names in a row contain the same special characters: each command meets all of these.
TEST_CASE("no name is a command: each command works, or fails with one line") {
    const auto names = tandem::test::nasty_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const NameFolder folder;
        write_inputs(folder, names[i]);
        const auto commands = commands_with(names[i]);
        for (std::size_t n = i % 3; n < commands.size(); n += 3)
            check_result(commands[n], folder.run(commands[n]));
        INFO(names[i]);
        CHECK_FALSE(folder.was_attacked());
    }
}

TEST_CASE("a component builds in folders whose names only a shell would act on") {
    for (const std::string name : {"a&touch marker&b", "-rf", "it's (1) {b} !", "é ~^@=,+"}) {
        const NameFolder folder;
        folder.write(name + "/Part.xml", profile);
        folder.write(name + "/Part.cpp", "#include <Component.h>\n#include \"part.h\"\n"
                                         "class Part : public Component {};\n"
                                         "extern \"C\" Component* getComponent() { return new Part; }\n");
        folder.write(name + ".headers/part.h", "");
        const std::string path = "./" + name;
        const auto built =
            folder.run({tandem_program, "opros", "build", path, "--build-dir", path + ".build", "--output",
                        path + ".out", "-I", path + ".headers", "-D", "TEXT=\"$(touch marker) `x`\""});
        INFO(built.output << built.errors);
        CHECK(built.succeeded());
        CHECK(fs::exists(folder.path() / (name + ".out") / "Part.so"));
        CHECK_FALSE(folder.was_attacked());
    }
}

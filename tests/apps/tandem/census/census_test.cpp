// SPDX-License-Identifier: Apache-2.0
// `tandem opros census` and `tandem rtm census` over folders of good and bad components.
#include "tests/apps/tandem/program.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

using tandem::test::shell;
using tandem::test::tandem_program;

namespace {

namespace fs = std::filesystem;

// Writes an RT-Component NAME with this body of onActivated().
void write_rtc(const Folder& folder, const std::string& name, const std::string& body,
               const std::string& include = "") {
    folder.write(
        "shelf/" + name + "/src/" + name + ".cpp",
        fmt::format("#include <rtm/DataFlowComponentBase.h>\n#include <rtm/Manager.h>\n"
                    "#include <csignal>\n#include <fstream>\n#include <iostream>\n#include <unistd.h>\n{1}"
                    "struct {0} : RTC::DataFlowComponentBase {{\n"
                    "  {0}(RTC::Manager* m) : RTC::DataFlowComponentBase(m) {{}}\n"
                    "  RTC::ReturnCode_t onActivated(RTC::UniqueId) override {{\n{2}\n"
                    "    return RTC::RTC_OK; }}\n"
                    "  RTC::ReturnCode_t onExecute(RTC::UniqueId) override {{ return RTC::RTC_OK; }}\n}};\n"
                    "extern \"C\" void {0}Init(RTC::Manager* m) {{\n"
                    "  const char* spec[] = {{\"implementation_id\", \"{0}\", \"type_name\", \"a{0}\",\n"
                    "    \"activity_type\", \"PERIODIC\", \"kind\", \"DataFlowComponent\", \"\"}};\n"
                    "  coil::Properties p(spec);\n"
                    "  m->registerFactory(p, RTC::Create<{0}>, RTC::Delete<{0}>);\n}}\n",
                    name, include, body));
}

void write_opros(const Folder& folder, const std::string& name, const std::string& body,
                 const std::string& period = "10") {
    folder.write(
        "shelf/" + name + "/" + name + ".cpp",
        fmt::format("#include <Component.h>\n#include <csignal>\n#include <cstdio>\n#include <cstdlib>\n"
                    "struct {0} : Component {{\n"
                    "  ReturnType onInitialize() override {{ return OPROS_SUCCESS; }}\n"
                    "  ReturnType onStart() override {{ return OPROS_SUCCESS; }}\n"
                    "  ReturnType onStop() override {{ return OPROS_SUCCESS; }}\n"
                    "  ReturnType onDestroy() override {{ return OPROS_SUCCESS; }}\n"
                    "  ReturnType onExecute() override {{ {1} return OPROS_SUCCESS; }}\n}};\n"
                    "extern \"C\" Component* getComponent() {{ return new {0}; }}\n"
                    "extern \"C\" void releaseComponent(Component* c) {{ delete c; }}\n",
                    name, body));
    folder.write("shelf/" + name + "/profile/" + name + ".xml",
                 fmt::format("<component_profile><name>{0}</name><execution_environment>"
                             "<library_name>{0}.dll</library_name></execution_environment>"
                             "<execution_semantics><type>periodic</type><period>{1}</period>"
                             "</execution_semantics></component_profile>",
                             name, period));
}

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

nlohmann::json row(const nlohmann::json& census, const std::string& component) {
    for (const auto& each : census["components"])
        if (each["component"] == component) return each;
    return {};
}

std::string error_of(const nlohmann::json& census, const std::string& component) {
    const auto found = row(census, component);
    return found.is_null() || found["error"].is_null() ? "" : found["error"].get<std::string>();
}

} // namespace

TEST_CASE(
    "a census of RT-Components goes on after each bad one, says what is wrong, and leaves nothing behind") {
    const Folder folder;
    write_rtc(folder, "Good", "");
    write_rtc(folder, "Crashing", "std::raise(SIGSEGV);");
    write_rtc(folder, "Hanging", "for (;;) pause();");
    write_rtc(folder, "Lacking", "", "#include <ode/no_such_header.h>\n");
    write_rtc(folder, "Broken", "this is no C++;");
    write_rtc(folder, "Failing", "RTC_ERROR((\"no arm at /dev/arm\")); return RTC::RTC_ERROR;");
    write_rtc(folder, "Lingering",
              "return RTC::RTC_OK; }\n  ~Lingering() override { for (;;) pause(); }\n"
              "  RTC::ReturnCode_t onReset(RTC::UniqueId) override {");
    // Reads its input, writes a file and makes a daemon.
    const std::string pid_file = folder.path() / "daemon";
    write_rtc(folder, "Rude",
              "std::string line; std::getline(std::cin, line); std::ofstream(\"left.txt\") << line;\n"
              "if (fork() == 0) { setsid(); if (fork() != 0) _exit(0);\n"
              "  std::ofstream(\"" +
                  pid_file + "\") << getpid() << std::flush; for (;;) pause(); }\n");
    const auto before = files_below(folder.path() / "shelf");
    const auto result =
        tandem_program({"rtm", "census", folder.path() / "shelf", "--json", "--seconds", "2"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 2);
    const auto census = result.json();
    CHECK(census["found"] == 8);
    CHECK(census["built"] == 6);
    CHECK(census["load"] == 6);
    CHECK(census["run"] == 2);
    CHECK(row(census, "Good")["runs"] == true);
    CHECK(row(census, "Good")["cycles"] > 10);
    CHECK(error_of(census, "Good") == "");
    CHECK(row(census, "Crashing")["loads"] == true);
    CHECK_THAT(error_of(census, "Crashing"), Catch::Contains("onActivated"));
    CHECK_THAT(error_of(census, "Hanging"), Catch::Contains("onActivated"));
    CHECK_THAT(error_of(census, "Failing"),
               Catch::StartsWith("goes to its error state: Failing0: no arm at /dev/arm"));
    CHECK_THAT(error_of(census, "Lingering"),
               Catch::StartsWith("runs, but its host exited with 1 at its end: ") &&
                   Catch::Contains("the destructor of Lingering0"));
    CHECK_THAT(error_of(census, "Lacking"),
               Catch::Contains("ode/no_such_header.h") && Catch::Contains("libode-dev"));
    CHECK_THAT(error_of(census, "Broken"), Catch::Contains("Broken.cpp:") && Catch::Contains("error: "));
    CHECK(row(census, "Rude")["runs"] == true);
    CHECK(files_below(folder.path() / "shelf") == before);
    CHECK(shell("kill -0 $(cat " + pid_file + ")").exit_code != 0);
}

TEST_CASE(
    "a census of OPRoS components prints a table as it goes, and profiles without sources are counted") {
    const Folder folder;
    write_opros(folder, "Good", "");
    write_opros(folder, "Crashing", "std::raise(SIGSEGV);");
    folder.write("shelf/bought/Bought.xml", "<component_profile><name>Bought</name></component_profile>");
    folder.write("shelf/data.xml", "<calibration/>");
    folder.write("shelf/device/Device.xml", "<component_profile><name>Bought</name></component_profile>");
    folder.write("shelf/device/device.cpp", "extern \"C\" void* GetAPI() { return nullptr; }\n");
    const auto result = tandem_program({"opros", "census", folder.path() / "shelf", "--seconds", "1"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 2);
    CHECK_THAT(
        result.output,
        Catch::StartsWith("COMPONENT") && Catch::Contains("BUILT  LOADS  CYCLES  FIRST ERROR") &&
            Catch::EndsWith(
                "2 components: 2 built, 2 load, 1 run; 2 component profiles have no source beside them\n"));
    const auto lines = std::count(result.output.begin(), result.output.end(), '\n');
    CHECK(lines == 4);
    CHECK_THAT(result.output, Catch::Contains("onExecute"));
}

TEST_CASE("the error of a component has the line that the component printed before") {
    const Folder folder;
    write_opros(folder, "Lost", "std::puts(\"no map in /data\"); getProperty(\"map\"); throw 1;");
    const auto shelf = folder.path() / "shelf";
    const auto census = tandem_program({"opros", "census", shelf, "--seconds", "1", "--json"}).json();
    CHECK_THAT(error_of(census, "Lost"),
               Catch::Contains("onExecute") && Catch::EndsWith("(line before: no map in /data)"));
}

TEST_CASE("a component of a census that opens a window of Qt needs no display") {
    const Folder folder;
    write_opros(folder, "Window",
                "if (!std::getenv(\"DISPLAY\") && !std::getenv(\"WAYLAND_DISPLAY\") && "
                "!std::getenv(\"QT_QPA_PLATFORM\")) throw 1;");
    const auto result = tandem_program({"opros", "census", folder.path() / "shelf", "--seconds", "1"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
}

TEST_CASE(
    "copies of a profile are one component of a census, including those in a workspace's common folder") {
    const Folder folder;
    write_opros(folder, "One", "");
    write_opros(folder, "Two", "");
    const auto shelf = folder.path() / "shelf";
    fs::create_directories(shelf / "profiles");
    for (const std::string name : {"One", "Two"}) {
        const auto profile = shelf / name / "profile" / (name + ".xml");
        fs::copy_file(profile, shelf / "profiles" / profile.filename());
        fs::copy_file(profile, shelf / name / profile.filename());
    }
    // A profile that differs is tried, too. This one is incomplete.
    fs::create_directories(shelf / "Two/profiles");
    folder.write("shelf/Two/profiles/Other.xml",
                 "<component_profile><name>Other</name><execution_environment><library_name>Other.dll"
                 "</library_name></execution_environment></component_profile>");
    const auto result = tandem_program({"opros", "census", shelf, "--seconds", "0.2", "--json"});
    INFO(result.output << result.errors);
    const auto census = result.json();
    CHECK(census["found"] == 3);
    CHECK(census["built"] == 2);
    CHECK(row(census, "One")["folder"] == (shelf / "One").string());
    CHECK(row(census, "Two")["folder"] == (shelf / "Two").string());
    CHECK(row(census, "Other")["folder"] == (shelf / "Two").string());
    CHECK(census["profiles_without_source"] == 0);
}

TEST_CASE("a census without components is an error, and a census in which all components run ends with exit "
          "code 0") {
    const Folder folder;
    folder.write("shelf/readme.txt", "");
    const auto none = tandem_program({"rtm", "census", folder.path() / "shelf"});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.errors, Catch::Contains("no component with sources"));
    CHECK(tandem_program({"rtm", "census", folder.path() / "nowhere"}).exit_code == 1);
    write_opros(folder, "Good", "");
    write_opros(folder, "Slow", "", "600000"); // its next tick comes after the census
    const auto shelf = folder.path() / "shelf";
    const auto all =
        tandem_program({"opros", "census", shelf, shelf / "Good", shelf, "--seconds", "1", "--json"});
    INFO(all.output << all.errors);
    CHECK(all.exit_code == 0);
    CHECK(all.json()["run"] == 2);
}

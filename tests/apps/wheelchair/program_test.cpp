// SPDX-License-Identifier: Apache-2.0
// The program as a user meets it: real time, bad input, the files it writes.
#include <catch2/catch.hpp>

#include <filesystem>

#include "program.hpp"
#include "scratch_dir.hpp"

namespace {

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

void check_refusal(const std::vector<std::string>& arguments, const std::string& complaint) {
    const auto result = wheelchair_program(arguments);
    INFO(result.errors);
    CHECK(result.exit_code() != 0);
    CHECK_THAT(result.errors, Catch::Contains(complaint));
    CHECK(lines(result.errors) == 1);
}

void check_real_time(const std::string& configuration) {
    const ScratchDir dir;
    const auto result =
        wheelchair_program({"--config", configuration, "--duration", "1.5", "--csv", dir / "run.csv",
                            "--json", dir / "run.json", "--plot", dir / "run.svg"});
    INFO(result.errors);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output,
               Catch::Contains("Table 1.") && Catch::Contains("p99.9") && Catch::Contains(" pid "));
    CHECK(lines(file_content(dir / "run.csv")) == 152);
    CHECK_THAT(file_content(dir / "run.json"),
               Catch::Contains("\"lost\": 0") && Catch::Contains("\"complete\": true"));
    CHECK_THAT(file_content(dir / "run.svg"), Catch::Contains("</svg>"));
}

} // namespace

TEST_CASE("bad input is refused in one line that names it") {
    const ScratchDir dir;
    std::ofstream(dir / "stick.csv") << "0,0,900,0\n1,0,nine,0\n";
    check_refusal({"--scenario", "step21"}, "no scenario 'step21'; there are step20");
    check_refusal({"--joystick", dir / "stick.csv"}, "stick.csv:2: 'nine' is not a number");
    check_refusal({"--joystick", "/nonexistent.csv"}, "/nonexistent.csv: cannot be read");
    check_refusal({"--csv", "/nonexistent/run.csv"}, "its folder does not exist");
    check_refusal({"--plot", dir / "run.pdf"}, ".svg or .png");
}

TEST_CASE("without hosts the program computes the result that every configuration must reproduce") {
    const ScratchDir dir;
    const auto result = wheelchair_program({"--config", "memory", "--json", dir / "run.json"});
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Catch::Contains("rise 10-90 %") && !Catch::Contains("FAIL"));
    CHECK_THAT(file_content(dir / "run.json"), Catch::Contains("\"good\": true"));
}

TEST_CASE("a comparison writes no file that the user did not ask for") {
    const ScratchDir dir;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(dir.path());
    const auto result = wheelchair_program({"--compare", "--lockstep", "--duration", "0.1"});
    std::filesystem::current_path(before);
    INFO(result.errors);
    CHECK_THAT(result.output, Catch::Contains("mixed"));
    CHECK(std::filesystem::is_empty(dir.path()));
}

TEST_CASE("a run with kept files can be repeated by hand") {
    const ScratchDir dir;
    const auto result =
        wheelchair_program({"--config", "opros", "--lockstep", "--duration", "0.1", "--keep", dir.path()});
    INFO(result.errors);
    CHECK(result.exit_code() == 0);
    CHECK(std::filesystem::exists(dir / "opros/wheelchair.xml"));
    CHECK(std::filesystem::exists(dir / "trace/HWComp.trace"));
    CHECK(std::filesystem::exists(dir / "log/opros_host.log"));
}

TEST_CASE("all-OPRoS runs in real time and loses nothing") { check_real_time("opros"); }

TEST_CASE("all-RTM runs in real time and loses nothing") { check_real_time("rtm"); }

TEST_CASE("mixed runs in real time and loses nothing") { check_real_time("mixed"); }

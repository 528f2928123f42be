// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <fstream>

using tandem::test::tandem_program;

namespace {
bool one_line(const std::string& text) { return std::count(text.begin(), text.end(), '\n') == 1; }
} // namespace

TEST_CASE("tandem opros new writes a component and prints the next steps") {
    const Folder folder;
    const auto made = tandem_program({"opros", "new", "Arm_2", "--in", folder.path()});
    REQUIRE(made.exit_code == 0);
    CHECK(made.output_contains("tandem opros build"));
    for (const char* file : {"Arm_2.h", "Arm_2.cpp", "Arm_2.xml", "Arm_2App.xml", "CMakeLists.txt"})
        CHECK(std::filesystem::file_size(folder.path() / "Arm_2" / file) > 50);
}

TEST_CASE("the profile of tandem opros new lists every execution type that hosts accept") {
    const Folder folder;
    tandem_program({"opros", "new", "Arm", "--in", folder.path()});
    const auto file = folder.path() / "Arm" / "Arm.xml";
    std::ifstream in(file);
    std::string profile(std::istreambuf_iterator<char>(in), {});
    const std::string begin = "<!-- type: ", type = "<type>periodic<";
    const auto comment = profile.find(begin);
    REQUIRE(comment != std::string::npos);
    const std::string listed = profile.substr(comment + begin.size(),
                                              profile.find_first_of(";\n", comment) - comment - begin.size());
    profile.replace(profile.find(type), type.size(), "<type>none<");
    folder.write("Arm/Arm.xml", profile);
    CHECK_THAT(tandem_program({"opros", "info", file}).errors,
               Catch::Contains("execution type 'none' is unknown, expected " + listed + "\n"));
}

TEST_CASE("tandem opros new refuses an invalid name in one line and creates no files") {
    const Folder folder;
    folder.write("There/mine.txt", "mine");
    const auto refused = [&](const std::string& name, const std::string& parent) {
        const auto result = tandem_program({"opros", "new", name, "--in", parent});
        CHECK(result.exit_code == 1);
        CHECK(one_line(result.errors));
        return result.errors;
    };
    CHECK_THAT(refused("There", folder.path()), Catch::Contains("There exists"));
    CHECK_THAT(refused("2Arms", folder.path()), Catch::Contains("'2Arms'"));
    CHECK_THAT(refused("../Arm", folder.path()), Catch::Contains("expected letters"));
    CHECK_THAT(refused("", folder.path()), Catch::Contains("expected letters"));
    CHECK_THAT(refused("virtual", folder.path()), Catch::Contains("a C++ keyword"));
    CHECK_THAT(refused("Component", folder.path()), Catch::Contains("the OPRoS API"));
    CHECK_THAT(refused("getComponent", folder.path()), Catch::Contains("the OPRoS API"));
    CHECK_THAT(refused("NULL", folder.path()), Catch::Contains("a C++ keyword"));
    CHECK_THAT(refused("string", folder.path()), Catch::Contains("the system's <string.h>"));
    CHECK_THAT(refused("Arm", folder.path() / "nowhere"), Catch::Contains("cannot be created"));
    const auto left = std::filesystem::directory_iterator(folder.path());
    CHECK(std::distance(begin(left), end(left)) == 1);
}

// SPDX-License-Identifier: Apache-2.0
// What `tandem opros build` and `tandem rtm build` learn from the CMake project of a component, with and without
// configuring it.
#include "apps/tandem/build/folder/cmake_lists.hpp"
#include "apps/tandem/build/project/cmake_projects.hpp"
#include "apps/tandem/build/select_sources.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tandem::command;

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

const std::string module_text = "void ArmInit(RTC::Manager* manager) {\n}\n";

Names names_of(const std::vector<fs::path>& files) {
    Names names;
    for (const auto& file : files) names.push_back(file.filename());
    std::sort(names.begin(), names.end());
    return names;
}

SelectedSources select(const fs::path& folder, CMakeProjects& projects, const SourceOptions& options = {}) {
    return select_sources(folder, {"ArmInit"}, options, {"Arm", projects});
}

} // namespace

TEST_CASE("branches of a CMakeLists.txt for other platforms are skipped, even if they set variables") {
    const Folder folder;
    folder.write("CMakeLists.txt",
                 "option(FAST \"moves fast (default)\" ON)\noption(SLOW \"moves slowly\" OFF)\n"
                 "if(WIN32)\n  set(FLAGS -D__WIN32__)\n  list(APPEND sources win.cpp)\n"
                 "elseif(APPLE)\n  add_definitions(-DMAC)\n"
                 "else()\n  list(APPEND sources posix.cpp)\n  add_definitions(-DPOSIX)\nendif()\n"
                 "if((FAST OR SLOW) AND NOT SLOW)\n  add_compile_definitions(QUICK=1)\nendif()\n"
                 "if(CMAKE_SYSTEM_NAME STREQUAL \"Windows\")\n  add_definitions(-DWINDOWS)\nendif()\n"
                 "if(NOT_KNOWN)\n  add_definitions(-DGUESSED)\n  set(FLAGS -DGUESSED)\nendif()\n"
                 "foreach(joint 1 2)\n  list(APPEND sources joint${joint}.cpp)\nendforeach()\n"
                 "add_definitions(${FLAGS})\nadd_library(Arm SHARED ${sources})\n");
    const auto lists = read_cmake_lists(folder.path());
    CHECK(lists.definitions == Names{"POSIX", "QUICK=1", "GUESSED"});
    REQUIRE(lists.targets.size() == 1);
    CHECK(lists.targets[0].words == Names{"Arm", "SHARED", "posix.cpp", "joint1.cpp", "joint2.cpp"});
}

TEST_CASE("macros of a project that add libraries are expanded, including those of the folder above and of "
          "included files") {
    const Folder folder;
    fs::create_directories(folder.path() / ".git");
    folder.write("cmake/rtc.cmake", "function(add_rtc_library name)\n  add_library(${name} SHARED ${ARGN})\n"
                                    "  add_executable(${name}Comp ${ARGN} ${name}Comp.cpp)\nendfunction()\n");
    folder.write("CMakeLists.txt",
                 "set(CMAKE_MODULE_PATH ${CMAKE_CURRENT_SOURCE_DIR}/cmake)\ninclude(rtc)\n");
    folder.write("arm/CMakeLists.txt", "add_rtc_library(Arm Arm.cpp Part.cpp)\n"
                                       "add_other_library(Hand Hand.cpp)\nadd_dependencies(Hand Arm)\n");
    const auto targets = read_cmake_lists(folder.path() / "arm").targets;
    REQUIRE(targets.size() == 3);
    CHECK(targets[0].words == Names{"Arm", "SHARED", "Arm.cpp", "Part.cpp"});
    CHECK_FALSE(targets[0].is_program);
    CHECK(targets[1].words == Names{"ArmComp", "Arm.cpp", "Part.cpp", "ArmComp.cpp"});
    CHECK(targets[1].is_program);
    CHECK(targets[2].words == Names{"Hand", "Hand.cpp"}); // of a macro that is not here
}

TEST_CASE("a macro that calls itself and a file that includes itself are not followed forever") {
    const Folder folder;
    folder.write("CMakeLists.txt",
                 "add_library(Arm Arm.cpp)\nmacro(again)\n  again()\n  again()\nendmacro()\nagain()\n"
                 "include(CMakeLists.txt)\nif(" +
                     std::string(100000, '(') + std::string(100000, ')') + ")\nendif()\nif(BROKEN\n");
    CHECK_FALSE(read_cmake_lists(folder.path()).targets.empty());
}

TEST_CASE("blocks within blocks and variables within variables are not followed forever") {
    const Folder folder;
    std::string text = "add_library(Arm Arm.cpp)\nset(a xxxxxxxxxxxxxxxx)\n";
    for (int i = 0; i < 6; ++i) text += "set(a ${a}${a}${a}${a}${a}${a}${a}${a})\n";
    std::string many = "set(b ";
    for (int i = 0; i < 10'000; ++i) many += "${a}";
    text += many + ")\n";
    for (int i = 0; i < 50'000; ++i) text += "if(ON)\n";
    folder.write("CMakeLists.txt", text + "add_definitions(-D${a})\n");
    const auto lists = read_cmake_lists(folder.path());
    CHECK(lists.targets.size() == 1);
    CHECK(lists.definitions.empty());
}

// A project with everything: a program with another source, a static library, branches, a header that configuring generates,
// and required packages that are missing.
TEST_CASE("CMake itself says what the library of a component compiles") {
    const Folder folder;
    fs::create_directories(folder.path() / ".git");
    folder.write(
        "CMakeLists.txt",
        "cmake_minimum_required(VERSION 2.8)\nproject(arms CXX)\nfind_package(NoSuchRobot REQUIRED)\n"
        "find_package(PkgConfig REQUIRED)\npkg_check_modules(GONE REQUIRED no-such-module)\n"
        "set(CMAKE_CXX_STANDARD 17)\nadd_subdirectory(arm)\n");
    folder.write("arm/config.h.in", "#define JOINTS @JOINTS@\n");
    folder.write(
        "arm/CMakeLists.txt",
        "if(WIN32)\n  add_definitions(-D__WIN32__)\nendif()\nset(JOINTS 6)\nconfigure_file(config.h.in "
        "config.h)\n"
        "include_directories(${CMAKE_CURRENT_BINARY_DIR} ../include)\n"
        "add_definitions(-DNAME=\"Arm 1\" -Wall -Werror -O3 -fopenmp)\n"
        "add_library(part STATIC Part.cpp)\nadd_library(unused STATIC Unused.cpp)\n"
        "add_library(Arm SHARED Arm.cpp)\nadd_dependencies(Arm unused)\ntarget_link_libraries(Arm part m)\n"
        "add_executable(ArmComp Arm.cpp ArmComp.cpp)\n");
    folder.write("include/units.h", "");
    folder.write("arm/Arm.cpp", module_text);
    for (const char* other : {"arm/Part.cpp", "arm/ArmComp.cpp", "arm/Unused.cpp", "arm/Old.cpp"})
        folder.write(other, "");
    CMakeProjects projects("", 60);
    const auto found = select(folder.path() / "arm", projects);
    CHECK(names_of(found.sources) == Names{"Arm.cpp", "Part.cpp"});
    CHECK(names_of(found.left_out) == Names{"ArmComp.cpp", "Old.cpp", "Unused.cpp"});
    CHECK(found.target.definitions == Names{"Arm_EXPORTS", "NAME=\"Arm 1\""});
    CHECK(found.target.options == Names{"-fopenmp"});
    CHECK(found.target.libraries == Names{"m"});
    CHECK(found.target.standard == 17);
    REQUIRE(found.target.include_dirs.size() == 2);
    CHECK(fs::exists(found.target.include_dirs[0] / "config.h"));
    CHECK(fs::exists(found.target.include_dirs[1] / "units.h"));
    CHECK_THAT(projects.problem(),
               Catch::EndsWith("requires packages that were not found: NoSuchRobot, no-such-module"));
    // The project says how to compile sources that the user names.
    CHECK(select(folder.path() / "arm", projects, {{"Arm.cpp"}, {}}).target.standard == 17);
}

TEST_CASE("a project that reports errors is configured, and one whose license file is missing") {
    const Folder folder;
    folder.write(
        "CMakeLists.txt",
        "cmake_minimum_required(VERSION 3.16)\nproject(arms CXX)\nadd_library(Arm SHARED Arm.cpp Part.cpp)\n"
        "set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/COPYING.LESSER)\ninclude(CPack)\n"
        "message(SEND_ERROR \"Doxygen was not found.\")\n");
    folder.write("Arm.cpp", module_text);
    for (const char* other : {"Part.cpp", "Old.cpp"}) folder.write(other, "");
    CMakeProjects projects("", 60);
    const auto found = select(folder.path(), projects);
    CHECK(projects.problem().empty());
    CHECK(found.target.name == "Arm");
    CHECK(names_of(found.sources) == Names{"Arm.cpp", "Part.cpp"});
}

TEST_CASE("a library that a project makes from object libraries has their sources") {
    const Folder folder;
    folder.write("CMakeLists.txt",
                 "project(arms CXX)\nadd_library(objects OBJECT Arm.cpp Part.cpp)\n"
                 "add_library(Arm MODULE $<TARGET_OBJECTS:objects>)\ntarget_link_libraries(Arm m)\n");
    folder.write("Arm.cpp", module_text);
    for (const char* other : {"Part.cpp", "Old.cpp"}) folder.write(other, "");
    CMakeProjects projects("", 60);
    const auto found = select(folder.path(), projects);
    CHECK(names_of(found.sources) == Names{"Arm.cpp", "Part.cpp"});
    CHECK(found.target.name == "Arm");
    CHECK(found.target.libraries == Names{"m"});
}

TEST_CASE("a project with only a program gives the sources without main()") {
    const Folder folder;
    const auto project = GENERATE("project(arms CXX)\n", "project(arms CXX)\ninclude(missing.cmake)\n");
    folder.write("CMakeLists.txt",
                 std::string(project) + "add_executable(ArmComp Arm.cpp Part.cpp ArmComp.cpp)\n");
    folder.write("Arm.cpp", module_text);
    folder.write("ArmComp.cpp", "int main(int, char**) {\n}\n");
    for (const char* other : {"Part.cpp", "Old.cpp"}) folder.write(other, "");
    CMakeProjects projects("", 60);
    const auto found = select(folder.path(), projects);
    CHECK(names_of(found.sources) == Names{"Arm.cpp", "Part.cpp"});
    CHECK(names_of(found.left_out) == Names{"ArmComp.cpp", "Old.cpp"});
}

TEST_CASE("libraries and folders of a project may have blanks and quotes in their names") {
    const Folder folder;
    folder.write("lib of arms/libgrip 2.a", "");
    folder.write("it's/libpalm.a", "");
    folder.write(
        "CMakeLists.txt",
        "cmake_minimum_required(VERSION 3.16)\nproject(arms CXX)\nlink_directories(\"${CMAKE_SOURCE_DIR}/lib "
        "of arms\")\n"
        "add_library(Arm MODULE Arm.cpp)\ntarget_link_libraries(Arm finger\n"
        "  \"${CMAKE_SOURCE_DIR}/lib of arms/libgrip 2.a\" \"${CMAKE_SOURCE_DIR}/it's/libpalm.a\")\n");
    folder.write("Arm.cpp", module_text);
    CMakeProjects projects("", 60);
    const auto target = select(folder.path(), projects).target;
    const auto top = fs::canonical(folder.path());
    CHECK(target.libraries == Names{"finger", top / "lib of arms/libgrip 2.a", top / "it's/libpalm.a"});
    CHECK(target.library_dirs == std::vector<fs::path>{top / "lib of arms"});
}

TEST_CASE("the C++ standard is the project's, even if named by its draft, and at least C++11") {
    const Folder folder;
    folder.write("Arm.cpp", module_text);
    for (const auto& [option, standard] :
         {std::pair("-std=c++98", 0), {"-std=c++0x", 11}, {"-std=c++1z", 17}, {"-std=gnu++20", 20}}) {
        folder.write("CMakeLists.txt", std::string("project(arms CXX)\nadd_compile_options(") + option +
                                           ")\nadd_library(Arm MODULE Arm.cpp)\n");
        CMakeProjects projects("", 60);
        const auto target = select(folder.path(), projects).target;
        INFO(option << ", " << target.name << " " << projects.problem());
        CHECK(target.standard == standard);
    }
}

// Projects as RTCBuilder and other tools generate them: for installations of OpenRTM-aist, and with templates that are not
// checked in.
TEST_CASE("a project's own FindOpenRTM.cmake and missing templates do not keep it from being configured") {
    const Folder folder;
    folder.write("cmake/FindOpenRTM.cmake", "file(STRINGS /nowhere/rtm/version.h lines)\n");
    folder.write("CMakeLists.txt", "project(arms CXX)\nset(CMAKE_MODULE_PATH ${CMAKE_SOURCE_DIR}/cmake)\n"
                                   "find_package(OpenRTM REQUIRED)\nset(JOINTS 6)\n"
                                   "configure_file(arms-config.cmake.in arms-config.cmake)\n"
                                   "configure_file(joints.h.in joints.h @ONLY)\n"
                                   "include_directories(${CMAKE_CURRENT_BINARY_DIR})\n"
                                   "add_library(Arm SHARED Arm.cpp)\n");
    folder.write("joints.h.in", "#define JOINTS @JOINTS@\n");
    folder.write("Arm.cpp", module_text);
    CMakeProjects projects("", 60);
    const auto target = select(folder.path(), projects).target;
    INFO(projects.problem());
    CHECK(projects.problem().empty());
    REQUIRE(target.include_dirs.size() == 1);
    CHECK(fs::exists(target.include_dirs[0] / "joints.h"));
}

TEST_CASE("a kept folder can be reused for another project") {
    const Folder folder, other;
    for (const auto* each : {&folder, &other}) {
        each->write("CMakeLists.txt", "project(arms CXX)\nadd_library(Arm MODULE Arm.cpp)\n");
        each->write("Arm.cpp", module_text);
    }
    for (const auto* each : {&folder, &other}) {
        CMakeProjects projects(folder.path() / "build", 60);
        CHECK(select(each->path(), projects).target.name == "Arm");
        CHECK(projects.problem().empty());
    }
}

TEST_CASE("a project that cannot be configured is read without running it, and the reason is known") {
    const Folder folder;
    folder.write("CMakeLists.txt",
                 "project(Arm)\ninclude(${NOWHERE}/missing.cmake)\nadd_library(Arm Arm.cpp Part.cpp)\n"
                 "add_executable(ArmComp Arm.cpp ArmComp.cpp)\n");
    folder.write("Arm.cpp", module_text);
    for (const char* other : {"Part.cpp", "ArmComp.cpp"}) folder.write(other, "");
    CMakeProjects projects("", 60);
    const auto found = select(folder.path(), projects);
    CHECK(names_of(found.sources) == Names{"Arm.cpp", "Part.cpp"});
    CHECK(found.target.sources.empty());
    CHECK_THAT(projects.problem(), Catch::Contains("CMakeLists.txt cannot be configured: CMake Error at") &&
                                       Catch::Contains("could not find requested file"));
}

TEST_CASE("a project that takes too long to configure or needs the network is stopped") {
    const Folder folder;
    folder.write("CMakeLists.txt", "project(Arm NONE)\nexecute_process(COMMAND sleep 60)\n");
    folder.write("Arm.cpp", module_text);
    CMakeProjects projects("", 0.5);
    CHECK(names_of(select(folder.path(), projects).sources) == Names{"Arm.cpp"});
    CHECK_THAT(projects.problem(), Catch::Contains("it takes too long"));
    folder.write("CMakeLists.txt",
                 "project(Arm NONE)\nfile(DOWNLOAD http://localhost/robot.zip ${CMAKE_BINARY_DIR}/robot.zip "
                 "STATUS status)\n"
                 "list(GET status 0 code)\nif(NOT code EQUAL 0)\n  include(no_network.cmake)\nendif()\n");
    CMakeProjects others("", 60);
    CHECK(names_of(select(folder.path(), others).sources) == Names{"Arm.cpp"});
    CHECK_THAT(others.problem(), Catch::Contains("could not find requested file"));
}

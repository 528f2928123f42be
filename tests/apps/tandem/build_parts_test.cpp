// SPDX-License-Identifier: Apache-2.0
// What `tandem opros build` and `tandem rtm build` decide before they compile, and what they say when that fails.
#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/cmake_lists.hpp"
#include "apps/tandem/build/folder/project_files.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/missing_names.hpp"
#include "apps/tandem/build/plain_path.hpp"
#include "apps/tandem/build/remedy.hpp"
#include "apps/tandem/build/select_sources.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace tandem::command;

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

const std::string entry = "Component* getComponent() {\n  return new Old;\n}\n";

Names names_of(const std::vector<fs::path>& files) {
    Names names;
    for (const auto& file : files) names.push_back(file.filename());
    return names;
}

Names selected(const fs::path& folder, const SourceOptions& options = {}) {
    CMakeProjects projects("", 60);
    return names_of(select_sources(folder, {"getComponent"}, options, {"Old", projects}).sources);
}

std::string refused(const fs::path& folder, const SourceOptions& options = {}) {
    CMakeProjects projects("", 60);
    try {
        select_sources(folder, {"getComponent"}, options, {"Old", projects});
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

// A component beside an older version of itself, as in many folders of OPRoS components.
void old_component(const Folder& folder) {
    folder.write("Old/Old.cpp", entry);
    folder.write("Old/OldBackup.cpp", entry);
    folder.write("Old/Helper.cpp", "");
    folder.write("common/Gain.cpp", "");
}

} // namespace

TEST_CASE("sources not listed in the folder's makefile, CMakeLists.txt or Visual C++ project are not built") {
    const Folder folder;
    const auto old = folder.path() / "Old";
    old_component(folder);
    const Names listed{"Old.cpp", "Helper.cpp", "Gain.cpp"};
    folder.write("Old/Makefile",
                 "NAME = Old # the library\nSRCS = $(NAME).cpp \\\n  Helper.cpp ../common/Gain.cpp\n"
                 "OBJS = $(SRCS:.cpp=.o)\n");
    CHECK(selected(old) == listed);
    CMakeProjects projects("", 60);
    CHECK(names_of(select_sources(old, {"getComponent"}, {}, {"Old", projects}).left_out) ==
          Names{"OldBackup.cpp"});
    folder.write("Old/Makefile", "OBJS = Old.o Helper.o ../common/Gain.o\nother: OldBackup.o\n");
    CHECK(selected(old) == listed);
    fs::remove(old / "Makefile");
    folder.write("Old/CMakeLists.txt",
                 "project(Old)\nset(srcs Old.cpp Helper.cpp) # OldBackup.cpp\n"
                 "add_library(Old MODULE ${srcs} ${MADE_ELSEWHERE}\n  ../common/Gain.cpp)\n");
    CHECK(selected(old) == listed);
    fs::remove(old / "CMakeLists.txt");
    folder.write("Old/Old.vcproj",
                 "<?xml version=\"1.0\" encoding=\"ks_c_5601-1987\"?>\n<VisualStudioProject><Files>\n"
                 "<File RelativePath=\".\\Old.cpp\"/><Filter><File RelativePath=\".\\Helper.cpp\"/>"
                 "<File RelativePath=\"..\\common\\Gain.cpp\"/></Filter>\n"
                 "<File RelativePath=\".\\OldBackup.cpp\"><FileConfiguration Name=\"Debug\" "
                 "ExcludedFromBuild=\"true\"/></File></Files></VisualStudioProject>\n");
    CHECK(selected(old) == listed);
    // A makefile is for this platform, a project of Visual C++ has files for Windows, too.
    folder.write("Old/Makefile.INOld", "OBJS = Old.o\n");
    CHECK(selected(old) == Names{"Old.cpp"});
}

TEST_CASE("several sources that define the entry point are named, and --exclude or --source selects one") {
    const Folder folder;
    const auto old = folder.path() / "Old";
    old_component(folder);
    CHECK_THAT(refused(old), Catch::Contains("Old.cpp, OldBackup.cpp each define getComponent()") &&
                                 Catch::Contains("--exclude FILE"));
    CHECK(selected(old, {{}, {"OldBackup.cpp"}}) == Names{"Helper.cpp", "Old.cpp"});
    CHECK(selected(old, {{}, {"*Backup*"}}) == Names{"Helper.cpp", "Old.cpp"});
    CHECK(selected(old, {{"Old.cpp", folder.path() / "common/Gain.cpp"}, {}}) ==
          Names{"Old.cpp", "Gain.cpp"});
    CHECK_THAT(refused(old, {{"Missing.cpp"}, {}}), Catch::Contains("--source Missing.cpp: no such file"));
    CHECK_THAT(refused(old, {{}, {"Missing.cpp"}}),
               Catch::Contains("--exclude Missing.cpp: no source file in"));
    // A list that only running the project file would reveal is ignored.
    folder.write("Old/Makefile", "SRCS = $(wildcard *.cpp)\n");
    CHECK_THAT(refused(old), Catch::Contains("each define getComponent()"));
}

TEST_CASE("sources outside src are found by the function that they define") {
    const Folder folder;
    folder.write("Deep/Source/Comp/Deep.cpp", entry);
    folder.write("Deep/Source/Comp/Part.cpp", "");
    folder.write("Deep/build/Deep.cpp", entry);
    folder.write("Deep/Tool/Program.cpp", entry + "int main() {}\n");
    CHECK(selected(folder.path() / "Deep") == Names{"Deep.cpp", "Part.cpp"});
    folder.write("Empty/readme.txt", "");
    CHECK_THAT(refused(folder.path() / "Empty"),
               Catch::Contains("no C++ source in") && Catch::Contains("--source FILE"));
}

TEST_CASE(
    "includes in the wrong case, with backslashes or of another folder resolve to the component's header") {
    const Folder folder;
    const auto source = folder.write("Old/Old.cpp", "#include \"gain.H\"\n#include \"math\\Vector.h\"\n"
                                                    "  #  include <Deep.h>\n// #include \"never.h\"\n"
                                                    "#include <vector>\n#include \"Here.h\"\n");
    folder.write("Old/Gain.h", "");
    folder.write("Old/Here.h", "");
    folder.write("Old/never.H", "");
    folder.write("Old/lib/math/vector.h", "");
    folder.write("Old/lib/Deep.h", "#include \"HERE.h\"\n");
    const auto scan = scan_includes(folder.path() / "Old", {source}, {});
    const auto meant = [&](const std::string& name) {
        const auto found = scan.forwards.find(name);
        return found == scan.forwards.end()
                   ? ""
                   : fs::path(found->second).lexically_relative(folder.path()).string();
    };
    CHECK(scan.forwards.size() == 4);
    CHECK(meant("gain.H") == "Old/Gain.h");
    CHECK(meant("math\\Vector.h") == "Old/lib/math/vector.h");
    CHECK(meant("Deep.h") == "Old/lib/Deep.h");
    CHECK(meant("HERE.h") == "Old/Here.h");
    const auto forwards = write_forwards(scan.forwards, folder.path() / "forwards");
    CHECK_THAT(text_of(forwards / "math\\Vector.h"),
               Catch::StartsWith("#include \"/") && Catch::Contains("Old/lib/math/vector.h\"\n"));
}

TEST_CASE(
    "a header generated from an IDL file above the component's folder selects that file and its includes") {
    const Folder folder;
    folder.write("idl/Greeter.idl", "#include \"Words.idl\"\ninterface Greeter {};\n");
    folder.write("idl/Words.idl", "");
    folder.write("idl/Other.idl", "");
    const auto source = folder.write("rtc/Hello/Hello.cpp", "#include \"project/idl/GreeterSkel.h\"\n");
    const auto scan = scan_includes(folder.path() / "rtc/Hello", {source}, {});
    CHECK(names_of(scan.idl_files) == Names{"Greeter.idl"}); // CMake adds what it includes
    REQUIRE(scan.forwards.count("project/idl/GreeterSkel.h") == 1);
    CHECK(scan.forwards.at("project/idl/GreeterSkel.h") == "GreeterSkel.h");
    const auto forwards = write_forwards(scan.forwards, folder.path() / "forwards");
    CHECK(text_of(forwards / "project/idl/GreeterSkel.h") == "#include <GreeterSkel.h>\n");
}

TEST_CASE("the whole checkout is searched for a header by the longest matching part of its path") {
    const Folder folder;
    CHECK(find_checkout(folder.path() / "Old").empty());
    fs::create_directories(folder.path() / ".git");
    folder.write("Old/Old.cpp", "");
    folder.write("lib/util/Gain.h", "a");
    folder.write("lib/other/Gain.h", "b");
    folder.write("One_V1.0/Device.h", "same");
    folder.write("Two_V1.0/Device.h", "same");
    folder.write("upstream/Component.h", "");
    folder.write("upstream/Archive.h", "");
    const auto checkout = find_checkout(folder.path() / "Old");
    REQUIRE(checkout == fs::canonical(folder.path()));
    const auto found = [&](const std::string& name) {
        Names names;
        for (const auto& file : find_in_checkout(checkout, name))
            names.push_back(file.lexically_relative(checkout).string());
        return names;
    };
    CHECK(found("robot/util/Gain.h") == Names{"lib/util/Gain.h"});
    CHECK(found("Gain.h") == Names{"lib/other/Gain.h", "lib/util/Gain.h"});
    CHECK(found("../One/Device.h") == Names{"One_V1.0/Device.h"});
    CHECK(found("gain.h").empty());
    CHECK(found("Archive.h").empty());
    folder.write("lib/Port.cpp", "namespace robot {\nvoid addPort(const char* name) {\n}\n}\n");
    folder.write("lib/Port.h", "namespace robot { void addPort(const char* name); }\n");
    CHECK(find_definitions(list_files_below(checkout), "robot::addPort(char const*)") ==
          std::vector<fs::path>{checkout / "lib/Port.cpp"});
    CHECK(find_definitions(list_files_below(checkout), "robot::removePort(char const*)").empty());
    folder.write("lib/Solver.cpp",
                 "int solve(int a) { return a; }\n#ifndef NO_MAIN\nint main() {}\n#endif\n");
    folder.write("lib/Program.cpp",
                 "int stop() { return 1; }\n#ifdef _WIN32\n#else\nint main() {}\n#endif\n");
    folder.write("lib/Gnu.cpp", "int stop() { return 2; }\nint\nmain (int, char**) {}\n");
    CHECK(find_definitions(list_files_below(checkout), "arm::solve(int)") ==
          std::vector<fs::path>{checkout / "lib/Solver.cpp"});
    CHECK(find_definitions(list_files_below(checkout), "stop()").empty());
    for (const char* symbol : {"vtable for Box<int (*)(int)>", "vtable for f()::Local", "vtable for ", "("})
        CHECK(find_definitions(list_files_below(checkout), symbol).empty());
    // The compiler looks for a name with "../" beside the folder that it searches.
    const auto forwards = write_forwards(
        {{"../One/Device.h", "/there/Device.h"}, {"../../../../../x.h", "/x"}}, folder.path() / "forwards");
    CHECK(text_of(forwards / "../One/Device.h") == "#include \"/there/Device.h\"\n");
    CHECK_FALSE(fs::exists(folder.path() / "x.h"));
}

TEST_CASE("a header that is not found may be in a submodule that is not checked out") {
    const Folder folder;
    fs::create_directories(folder.path() / ".git");
    folder.write(".gitmodules", "[submodule \"arm\"]\n\tpath = lib/arm\n\turl = https://example.org/arm\n"
                                "[submodule \"hand\"]\n\tpath=lib/hand \n");
    folder.write("Arm/Arm.cpp", "");
    folder.write("lib/hand/Hand.h", "");
    fs::create_directories(folder.path() / "lib/arm");
    const auto remedy = [&](const std::string& header) {
        return find_remedy("Arm.cpp:3:10: fatal error: " + header + ": No such file or directory",
                           {folder.path() / "Arm", {}, {}, folder.path() / "nothing installed"});
    };
    CHECK(remedy("arm/Joint.h") == "lib/arm of this repository is not checked out: git -C " +
                                       fs::canonical(folder.path()).string() + " submodule update --init");
    CHECK(remedy("ode/ode.h") == "apt install libode-dev");
    folder.write("lib/arm/Joint.c", "");
    CHECK_THAT(remedy("arm/Joint.h"), Catch::Contains("-I DIR"));
}

TEST_CASE("unconditional definitions of the project's CMakeLists.txt are used") {
    const Folder folder;
    fs::create_directories(folder.path() / ".git");
    folder.write("CMakeLists.txt", "set(MAJOR 3)\nset(IOB_VERSION 4 CACHE STRING \"of the interface\")\n"
                                   "add_definitions(-DROBOT_VERSION=\\\"\\\\\"${MAJOR}.1\\\\\"\\\")\n"
                                   "add_definitions(-DIOB=${IOB_VERSION} -DUNKNOWN=${NOT_KNOWN} -Wall)\n"
                                   "if(WIN32)\n add_definitions(-DWIN32_LEAN)\nendif()\n");
    folder.write("rtc/CMakeLists.txt", "ADD_DEFINITIONS(-DNAME=\"${MAJOR}\" -DPLAIN)\n");
    const auto rtc = folder.path() / "rtc";
    CHECK(read_cmake_lists(rtc).definitions ==
          Names{"ROBOT_VERSION=\"3.1\"", "IOB=4", "NAME=\"3\"", "PLAIN"});
    fs::remove(folder.path() / ".git"); // the folders above are not the component's
    CHECK(read_cmake_lists(rtc).definitions == Names{"PLAIN"});
}

TEST_CASE("what a configure script defines on every machine is used without CMakeLists.txt") {
    const Folder folder;
    fs::create_directories(folder.path() / ".git");
    folder.write(
        "configure.ac",
        "# AC_DEFINE([COMMENT])\ndnl AC_DEFINE([NOTE])\n"
        "AC_INIT([Robot Ears], [2.1],\n  [me@example.org])\nAM_INIT_AUTOMAKE([1.10 tar-ustar])\n"
        "PKG_CHECK_MODULES([GUI], [gui],\n [AC_DEFINE([HAVE_GUI], [1], [if it is there])])\n"
        "case ${host_os} in\n  *mingw*) AC_DEFINE([ON_WINDOWS]);;\nesac\n"
        "if test x = y; then AC_DEFINE([CHOSEN]); fi\n"
        "if a; then b; else if c; then AC_DEFINE([NESTED]); fi; fi\nif a; then\nAC_DEFINE([AFTER])\nfi\n"
        "test x = y && AC_DEFINE([GUARDED])\ntest z ||\n AC_DEFINE([ELSE])\nm4_ifdef([NEW], "
        "[AC_DEFINE([OF_NEW])])\n"
        "# \xe9\nAC_DEFINE([RETURN],\r\n  [2])\nAC_DEFINE([BELL], [\a])\n"
        "AC_DEFINE([FLOATING_POINT], [], [Compile as floating-point]) dnl (not fixed)\n"
        "AC_DEFINE(CHANNELS, 8, [how many (at most)])\nAC_DEFINE([NAME], [\"ears\"])\n"
        "AC_DEFINE([FULL])\nAC_DEFINE([PLACE], [\"$prefix\"])\n");
    const auto rtc = folder.path() / "src";
    folder.write("src/Ears.cpp", "");
    CHECK(read_definitions(rtc) == Names{"PACKAGE_NAME=\"Robot Ears\"", "PACKAGE_VERSION=\"2.1\"",
                                         "PACKAGE=\"robot-ears\"", "VERSION=\"2.1\"", "RETURN=2",
                                         "FLOATING_POINT=", "CHANNELS=8", "NAME=\"ears\"", "FULL=1"});
    folder.write("src/CMakeLists.txt", "add_definitions(-DPLAIN)\n");
    CHECK(read_definitions(rtc) == Names{"PLAIN"});
}

TEST_CASE("an error about a header or a library is followed by a remedy") {
    const Folder folder;
    folder.write("Old/Old.cpp", "");
    folder.write("Neighbour/include/Gain.h", "");
    const auto remedy = [&](const std::string& error) {
        return find_remedy(error, {folder.path() / "Old", {}, {}, folder.path() / "nothing installed"});
    };
    const auto no_header = [&](const std::string& name) {
        return remedy("/x/Old.cpp:3:10: fatal error: " + name + ": No such file or directory");
    };
    CHECK(no_header("ode/ode.h") == "apt install libode-dev");
    CHECK(no_header("libresample.h") == "apt install libresample1-dev");
    CHECK(no_header("XnCppWrapper.h") == "apt install libopenni-dev");
    CHECK(no_header("cv_bridge/cv_bridge.h") == "apt install libcv-bridge-dev");
    for (const char* drawstuff : {"drawstuff/drawstuff.h", "drawstuff.h"})
        CHECK(
            no_header(drawstuff) ==
            drawstuff +
                std::string(
                    " belongs to a demonstration library in the source archive of ODE, which Debian does not "
                    "package: build it, then add its headers with -I DIR and its library with -l NAME"));
    CHECK(no_header("opencv/cv.h") == "apt install libopencv-dev");
    CHECK(no_header("Gain.h") == "-I " + (fs::canonical(folder.path()) / "Neighbour/include").string());
    folder.write("Other/Gain.h", "");
    CHECK_THAT(no_header("Gain.h"), Catch::Contains("Neighbour/include") && Catch::Contains(", or -I "));
    CHECK_THAT(no_header("afxwin.h"), Catch::Contains("a Windows header"));
    CHECK_THAT(no_header("progid:Stick.Device.1"), Catch::Contains("a Windows header"));
    CHECK_THAT(no_header("Vendor.h"), Catch::Contains("-I DIR"));
    CHECK(no_header("glut.h") == "if GL/glut.h is meant: apt install libglut-dev");
    CHECK(remedy("Old.cpp:9: undefined reference to `cvReleaseImage'") == "apt install libopencv-dev");
    CHECK(remedy("Old.cpp:9: undefined reference to `jpeg_CreateDecompress'") == "apt install libjpeg-dev");
    CHECK(remedy("Old.cpp:9: undefined reference to `boost::thread::join()'") ==
          "apt install libboost-thread-dev");
    CHECK_THAT(remedy("Old.cpp:9: undefined reference to `nowhere()'"), Catch::Contains("--source FILE"));
    CHECK(remedy("/usr/bin/ld: cannot find -lode: No such file or directory") == "apt install libode-dev");
    const auto header =
        folder
            .write("Old/arch.h", "#ifndef ARCH_H\n#define ARCH_H\n#ifdef FIXED\n#ifdef SSE\n"
                                 "#error not with SSE\n#endif\n#elif defined( FAST ) // quick\n"
                                 "#else\n#ifdef LOG\n#endif\n#error neither\n#endif\n"
                                 "#ifndef SIZE\n#error no SIZE\n#endif\n#endif\n")
            .string();
    CHECK(remedy(header + ":5:2: error: #error not with SSE").empty());
    CHECK(remedy(header + ":11:2: error: #error neither") == "-D FIXED, or -D FAST");
    CHECK(remedy(header + ":14:2: error: #error no SIZE") == "-D SIZE");
    CHECK(remedy("Old.cpp:1:2: error: 'GetTickCount' was not declared in this scope") ==
          "GetTickCount belongs to Windows: this source cannot be built on Linux");
    const auto camera =
        folder.write("Old/camera.h", "// for __stdcall\n__declspec(dllexport) int open();\n").string();
    CHECK(remedy(camera + ":1:1: error: expected unqualified-id").empty());
    CHECK(remedy(camera + ":2:11: error: expected constructor before '(' token") ==
          "__declspec belongs to Windows: this source cannot be built on Linux");
    CHECK(remedy("Old.cpp:1:2: error: no matching function for call to 'std::exception::exception(const char "
                 "[5])'") == "only Visual C++ has std::exception with a text: throw std::runtime_error");
    CHECK(remedy("Old.h:1:2: error: 'MINE' does not name a type").empty());
    CHECK(remedy("Old.cpp:9:3: error: expected ';' before '}' token").empty());
    CHECK(dropped_by_opencv("a.cpp:1:2: error: \u2018cvHaarDetectObjects\u2019 was not declared") ==
          "cvHaarDetectObjects");
    CHECK(dropped_by_opencv(
              "a.cpp:1:2: error: no matching function for call to \u2018cv::Mat::Mat(IplImage*&)\u2019") ==
          "cv::Mat(IplImage*)");
    CHECK(dropped_by_opencv("a.cpp:1:2: error: \u2018helper\u2019 was not declared").empty());
}

TEST_CASE("errors of clang and lld are understood like those of g++ and ld") {
    const std::string other = "Old.cpp:3:5: warning: unused variable 'unknown' [-Wunused-variable]\n";
    const auto output =
        output_worded_as_gcc(other + "Old.cpp:4:10: fatal error: 'Gain.h' file not found\n"
                                     "Old.cpp:9:33: error: unknown type name 'BOOL'\n"
                                     "Old.cpp:9:46: error: use of undeclared identifier 'TRUE'\n"
                                     "Old.cpp:9:60: error: no type named 'thread' in namespace 'std'\n"
                                     "Old.cpp:9:70: error: no member named 'sort' in namespace 'std'\n"
                                     "ld.lld: error: undefined symbol: Helper::get()\n");
    CHECK(output.starts_with(other));
    CHECK(missing_headers(output) == Names{"Gain.h"});
    CHECK(first_error(output) == "Old.cpp:4:10: fatal error: Gain.h: No such file or directory");
    CHECK(missing_names(output) == std::map<std::string, std::string>{{"BOOL", "typedef int BOOL;"},
                                                                      {"TRUE", "#define TRUE 1"},
                                                                      {"<thread>", "#include <thread>"}});
    CHECK(undefined_symbols(output) == std::set<std::string>{"Helper::get()"});
}

TEST_CASE("a path is refused only if a reader would take a part of it for its own language") {
    for (const char* path : {"/a b", "/it's", "/a&b", "/(a)", "/~a", "/-rf", "/é", "/a=b@c+d^e,f!g{h}"}) {
        CHECK_NOTHROW(require_cmake_path(path));
        CHECK_NOTHROW(require_idl_path(path));
    }
    for (const char* path : {"/a;b", "/a$b", "/a\"b", "/a`b", "/a\\b", "/a#b", "/a%b", "/a|b", "/<a>", "/[a]",
                             "/a*", "/a?", "/a:b", "/a\nb", "/a\x1b"})
        CHECK_THROWS_WITH(require_cmake_path(path),
                          Catch::Contains(" in its name, which CMake or make does not read"));
    for (const char* path : {"/a$b", "/a\"b", "/a`b", "/a\\b", "/a\nb", "/a\xff"})
        CHECK_THROWS_WITH(require_idl_path(path),
                          Catch::Contains(" in its name, which omniidl does not read"));
    for (const char* path : {"/a,b", "/a\nmanager.modules.preload: x.so", "/a\\", "/a "})
        CHECK_THROWS_WITH(require_conf_path(path),
                          Catch::Contains(" in its name, which rtc.conf cannot contain"));
    CHECK_NOTHROW(require_conf_path("/a$b: c;d"));
}

TEST_CASE("a component type whose name or category rtc.conf would read as something else is refused") {
    CHECK_NOTHROW(require_conf_type("Arm_2", "Mobile Robot", "/Arm.so"));
    CHECK_NOTHROW(require_conf_type("Ärm", "c", "/Arm.so"));
    for (const char* name : {"", "a,b", "a?x=y", "a&b", "a b", "a.b", "a\nmanager.modules.preload: x.so"})
        CHECK_THROWS_WITH(require_conf_type(name, "c", "/Arm.so"),
                          Catch::StartsWith("/Arm.so registers a component type with the name '"));
    for (const char* category : {"a:b", "a=b", "a\nb", "!a", " a", "a "})
        CHECK_THROWS_WITH(require_conf_type("Arm", category, "/Arm.so"),
                          Catch::StartsWith("/Arm.so registers a component type with the category '"));
}

TEST_CASE("options of a build that CMake or a shell would read as something else are refused") {
    for (const char* library : {"m", "boost_thread", "/usr/lib/a b.so", "-lm", "stdc++"})
        CHECK_NOTHROW(require_library(library));
    for (const char* library : {"", "m;x", "$(x)", "`x`", "m x", "a&b"})
        CHECK_THROWS(require_library(library));
    CHECK_NOTHROW(require_pkg_config_module("gtk+-2.0"));
    for (const char* module : {"", "-x", "a;b", "$(x)"}) CHECK_THROWS(require_pkg_config_module(module));
    for (const char* definition : {"FAST", "A=1", "T=\"a $(b) `c`\"", "_A(x)=x"})
        CHECK_NOTHROW(require_definition(definition));
    for (const char* definition : {"", "-A", "A=1;B", "A=#", "A=$<1:x>", "A=\n"})
        CHECK_THROWS(require_definition(definition));
}

// SPDX-License-Identifier: Apache-2.0
// What `tandem opros build` adds to a component that lacks headers, sources or declarations.
#include "tests/apps/tandem/opros/old_component.hpp"
#include "tests/support/skip.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

using tandem::test::build;
using tandem::test::old_component;

namespace fs = std::filesystem;

TEST_CASE("a header that exists once in the checkout is used, and options are suggested for several") {
    const Folder folder;
    old_component(folder, "");
    fs::create_directories(folder.path() / ".git");
    fs::rename(folder.path() / "Old/src/Helper.cpp", folder.path() / "Old/Helper.cpp");
    folder.write("neighbour/Gain.h",
                 "#include \"../Device/Device.h\"\ninline double gain() { return device(); }\n");
    folder.write("Device_V1.0/Device.h", "inline double device() { return 3; }\n");
    const auto built = build({folder.path() / "Old"});
    INFO(built.output << built.errors);
    REQUIRE(built.exit_code == 0);
    CHECK_THAT(built.errors, Catch::Contains("tandem: Gain.h is not in ") &&
                                 Catch::Contains("; using the file found elsewhere in this repository: ") &&
                                 Catch::Contains("neighbour/Gain.h\n") &&
                                 Catch::Contains("Device_V1.0/Device.h\n"));
    CHECK(std::count(built.errors.begin(), built.errors.end(), '\n') == 2);
    folder.write("neighbour/Gain.h", "double gain();\n");
    folder.write("neighbour/Gain.cpp", "#include \"Gain.h\"\ndouble gain() { return 3; }\n");
    const auto linked = build({folder.path() / "Old"});
    CHECK(linked.exit_code == 0);
    CHECK_THAT(linked.errors, Catch::Contains("tandem: gain() is undefined; also compiling ") &&
                                  Catch::Contains("neighbour/Gain.cpp\n"));
    // Sources that the user names are complete.
    const auto unlinked =
        build({folder.path() / "Old", "--source", "Old.cpp", "--source", "Helper.cpp"}).errors;
    INFO(unlinked);
    CHECK_THAT(unlinked,
               Catch::Contains("another source file of this repository defines it: use --source ") &&
                   Catch::Contains("neighbour/Gain.cpp (the compiler's output is above)"));
    folder.write("other/Gain.h", "inline double gain() { return 4; }\n");
    const auto top = fs::canonical(folder.path()).string();
    CHECK_THAT(build({folder.path() / "Old"}).errors,
               Catch::Contains("Gain.h: No such file or directory; -I " + top + "/neighbour, or -I " + top +
                               "/other ("));
}

TEST_CASE("an incomplete copy of a library in the checkout is not used if Debian has the library") {
    const Folder folder;
    old_component(folder, "");
    fs::create_directories(folder.path() / ".git");
    folder.write("neighbour/Gain.h", "#include <miniupnpc/miniupnpc.h>\n");
    folder.write("windows_sdk/miniupnpc/miniupnpc.h", "#include <upnp_of_windows.h>\n");
    CHECK_THAT(
        build({folder.path() / "Old"}).errors,
        Catch::Contains("upnp_of_windows.h: No such file or directory; apt install libminiupnpc-dev: its "
                        "miniupnpc/miniupnpc.h replaces the one of this repository"));
}

TEST_CASE(
    "an installed library with a function that the linker misses is linked, and its headers come first") {
    if (!fs::exists("/usr/include/opencv4/opencv2/core/utility.hpp"))
        TANDEM_SKIP("libopencv-dev is not installed");
    const Folder folder;
    old_component(folder, "");
    folder.write("neighbour/Gain.h", "namespace cv { long getTickCount(); }\n"
                                     "inline double gain() { return cv::getTickCount(); }\n");
    const auto built = build({folder.path() / "Old", "-I", folder.path() / "neighbour"});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK_THAT(built.errors,
               Catch::Contains("tandem: cv::getTickCount() is undefined; using opencv4 of package "
                               "libopencv-dev\n"));
}

// As the makefiles of OPRoS's generator, which list only the component's own source.
TEST_CASE(
    "a source that no makefile lists is compiled if it defines what is missing, once of several copies") {
    const Folder folder;
    old_component(folder, "");
    folder.write("Old/Makefile", "SRCS = Old.cpp\nCFLAGS = -I../neighbour\n");
    folder.write("Old/Helper.h",
                 "struct Helper { double get(); };\nstruct Scale { virtual double operator()(double); "
                 "};\ninline double helped() { return Scale()(Helper().get()); }\n");
    folder.write("Old/Scale.cpp",
                 "#include \"Helper.h\"\ndouble Scale::operator()(double x) { return x; }\n");
    folder.write("Old/src/Helper.cpp", "#include \"Helper.h\"\ndouble Helper::get() { return 2; }\n");
    folder.write("Old/Helper.cpp", "#include \"Helper.h\"\ndouble Helper::get() { return 2; }\n");
    folder.write("Old/Other.cpp",
                 "#error not needed\nstruct Other { double get(); };\ndouble Other::get() { return 3; }\n");
    const auto built = build({folder.path() / "Old"});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK_THAT(built.errors, Catch::Contains("tandem: Helper::get() is undefined; also compiling ") &&
                                 Catch::Contains("Old/Helper.cpp\n") &&
                                 Catch::Contains("tandem: vtable for Scale is undefined; also compiling "));
    CHECK(std::count(built.errors.begin(), built.errors.end(), '\n') == 2);
}

TEST_CASE("simple names of Windows and standard headers are added if a source lacks them") {
    const Folder folder;
    old_component(folder, "BOOL found = TRUE; typedef int BOOL; BYTE byte = 1; (void)found; (void)byte; "
                          "std::forward_list<int> queue; Sleep(0); _mkdir(\".\");");
    folder.write("Old/wheel.c", "int wheels(void) { return 4; }\n"); // C has no <forward_list>
    const std::vector<std::string> arguments{folder.path() / "Old", "-I", folder.path() / "neighbour"};
    const auto built = build(arguments);
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK_THAT(built.errors,
               Catch::Contains("tandem: BOOL is missing; adding: typedef int BOOL;\n") &&
                   Catch::Contains("#define TRUE 1\n") && Catch::Contains("BYTE") &&
                   Catch::Contains("tandem: Sleep is missing; adding: static inline void Sleep(") &&
                   Catch::Contains("adding: #include <sys/stat.h>\n") &&
                   Catch::Contains("adding: #include <forward_list>\n"));
    old_component(folder, "DWORD now = GetTickCount(); (void)now;");
    CHECK_THAT(build(arguments).errors,
               Catch::Contains("GetTickCount belongs to Windows: this source cannot be built on Linux"));
}

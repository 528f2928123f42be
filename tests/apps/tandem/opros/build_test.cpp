// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/opros/old_component.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/support/skip.hpp"

#include <algorithm>

using tandem::test::build;
using tandem::test::old_component;
using tandem::test::tandem_program;

namespace {

namespace fs = std::filesystem;

std::string error_of(std::vector<std::string> arguments) { return build(std::move(arguments)).errors; }

std::vector<std::string> files_in(const fs::path& dir) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(dir)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

TEST_CASE("a component is built with the build type of the option, of the environment, or optimized") {
    const Folder folder;
    const auto dir = folder.path() / "Fresh";
    REQUIRE(tandem_program({"opros", "new", "Fresh", "--in", folder.path()}).exit_code == 0);
    const auto build_type = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{dir, "--build-dir", folder.path() / "kept"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto built = build(arguments);
        INFO(built.errors);
        CHECK(built.exit_code == 0);
        std::ifstream cache(folder.path() / "kept/bin/CMakeCache.txt");
        for (std::string line; std::getline(cache, line);)
            if (line.starts_with("CMAKE_BUILD_TYPE:")) return line.substr(line.find('=') + 1);
        return std::string("none in the cache");
    };
    unsetenv("CMAKE_BUILD_TYPE");
    CHECK(build_type({}) == "RelWithDebInfo");
    setenv("CMAKE_BUILD_TYPE", "Release", 1);
    CHECK(build_type({}) == "Release");
    CHECK(build_type({"--build-type", "Debug"}) == "Debug");
    CHECK_THAT(build({dir, "--build-type", "Debgu"}).errors,
               Catch::Contains("--build-type: Debgu") && Catch::Contains("RelWithDebInfo"));
    setenv("CMAKE_BUILD_TYPE", "Debgu", 1);
    CHECK_THAT(build({dir}).errors, Catch::Contains("Debgu") && Catch::Contains("RelWithDebInfo"));
    unsetenv("CMAKE_BUILD_TYPE");
}

TEST_CASE("a component made by tandem opros new is built by tandem opros build and runs") {
    const Folder folder;
    const auto dir = folder.path() / "Fresh";
    REQUIRE(tandem_program({"opros", "new", "Fresh", "--in", folder.path()}).exit_code == 0);
    const auto built = build({dir});
    INFO(built.output << built.errors);
    REQUIRE(built.exit_code == 0);
    CHECK(built.output == (dir / "Fresh.so").string() + "\n");
    CHECK(files_in(dir) == std::vector<std::string>{"CMakeLists.txt", "Fresh.cpp", "Fresh.h", "Fresh.so",
                                                    "Fresh.xml", "FreshApp.xml"});
    const auto ran = tandem::test::run_host(OPROS_HOST, dir / "FreshApp.xml");
    INFO(ran.output);
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.output, Catch::Contains("Fresh: started, gain 2") && Catch::Contains("ready"));
    CHECK(tandem_program({"opros", "check", dir / "FreshApp.xml"}).exit_code == 0);
}

TEST_CASE("a component is built from its folder and a neighbour's headers into a plugin beside its profile") {
    const Folder folder;
    old_component(folder, "");
    const auto built = build({folder.path() / "Old", "-I", folder.path() / "neighbour"});
    INFO(built.output << built.errors);
    REQUIRE(built.exit_code == 0);
    CHECK(files_in(folder.path() / "Old/profile") ==
          std::vector<std::string>{"Old.so", "Old.xml", "OldService.xml"});
    CHECK(files_in(folder.path() / "Old") ==
          std::vector<std::string>{"Helper.h", "Old.cpp", "mfc", "profile", "src"});
    CHECK(tandem_program({"opros", "info", folder.path() / "Old/profile/Old.xml"})
              .output_contains("output     out   double"));
    const auto elsewhere = folder.path() / "elsewhere";
    REQUIRE(
        build({folder.path() / "Old", "-I", folder.path() / "neighbour", "--output", elsewhere}).exit_code ==
        0);
    CHECK(files_in(elsewhere) == std::vector<std::string>{"Old.so", "Old.xml", "OldService.xml"});
}

TEST_CASE("the last line of a failed build is its first error, and the old plugin stays") {
    const Folder folder;
    old_component(folder, "undeclared_thing();");
    folder.write("Old/profile/Old.so", "the old one");
    const auto failed = [&](std::vector<std::string> arguments) {
        const auto result = build(std::move(arguments));
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        CHECK(files_in(folder.path() / "Old/profile") ==
              std::vector<std::string>{"Old.so", "Old.xml", "OldService.xml"});
        CHECK(fs::file_size(folder.path() / "Old/profile/Old.so") == 11);
        return result.errors;
    };
    const std::string old = folder.path() / "Old", neighbour = folder.path() / "neighbour";
    CHECK_THAT(failed({old, "-I", neighbour}),
               Catch::Contains("Old.cpp:9:") && Catch::Contains("undeclared_thing"));
    CHECK_THAT(failed({old}), Catch::Contains("Gain.h"));
    old_component(folder, "extern void nowhere(); nowhere();");
    CHECK_THAT(failed({old, "-I", neighbour}),
               Catch::Contains("undefined reference") && Catch::Contains("nowhere"));
    CHECK_THAT(failed({old, "-I", folder.path() / "missing"}), Catch::Contains("missing is not a folder"));
    CHECK_THAT(failed({neighbour}), Catch::Contains("no component profile"));
    CHECK_THAT(failed({"/nowhere"}), Catch::Contains("/nowhere is not a folder"));
    folder.component("Old/Second", "Second.dll");
    CHECK_THAT(failed({old}), Catch::Contains("several component profiles") && Catch::Contains("--profile"));
}

TEST_CASE("names that cannot be built are refused before anything is built") {
    const Folder folder;
    old_component(folder, "");
    folder.component("Old/profile/Old", "Old $(date)");
    const auto refused = [&](std::vector<std::string> arguments) {
        const auto result = build(std::move(arguments));
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        return result.errors;
    };
    CHECK_THAT(refused({folder.path() / "Old"}),
               Catch::Contains("Old.xml:3: invalid library name 'Old $(date)'"));
    folder.component("Old/profile/Old", "Old.dll");
    fs::rename(folder.path() / "Old", folder.path() / "O;d");
    CHECK_THAT(refused({folder.path() / "O;d"}), Catch::Contains("O;d has a ';' in its name"));
    fs::rename(folder.path() / "O;d", folder.path() / "Old");
    const std::string old = folder.path() / "Old";
    CHECK_THAT(refused({old, "--build-dir", folder.path() / "p$(x)"}),
               Catch::Contains("p$(x) has a '$' in its name"));
    CHECK_THAT(refused({old, "--output", folder.path() / "a\nb"}),
               Catch::Contains("a?b has a control character"));
    CHECK_THAT(refused({old, "-I", folder.path() / "neighbour", "-l", "m;x"}),
               Catch::Contains("-l 'm;x' is not a library"));
    CHECK_THAT(refused({old, "--pkg-config", "$(x)"}), Catch::Contains("'$(x)' is not a module"));
    CHECK_THAT(refused({old, "-D", "A=1;2"}), Catch::Contains("cannot pass on a ';'"));
    std::ofstream(folder.path() / "Old/a`x`.cpp");
    CHECK_THAT(refused({old}), Catch::Contains("a`x`.cpp has a '`' in its name"));
}

TEST_CASE("a plugin that cannot be copied leaves no partial file") {
    const Folder folder;
    old_component(folder, "");
    fs::create_directory(folder.path() / "Old/profile/Old.so");
    const auto result = build({folder.path() / "Old", "-I", folder.path() / "neighbour"});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.errors, Catch::Contains("Old.so cannot be written: Is a directory"));
    CHECK(files_in(folder.path() / "Old/profile") ==
          std::vector<std::string>{"Old.so", "Old.xml", "OldService.xml"});
}

TEST_CASE("the last line of a failed CMake configuration is CMake's own error") {
    const Folder folder;
    folder.component("Empty/Empty", "Empty.dll");
    const auto result = build({folder.path() / "Empty"});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.errors, Catch::Contains("no C++ source in"));
}

TEST_CASE("a function without a return statement continues after its call, as with old compilers") {
    const Folder folder;
    folder.write("Old/Old.cpp",
                 "#include <Component.h>\n#include <vector>\n"
                 "class Old : public Component {\n  int count;\n"
                 "  int fill(int n) { std::vector<int> values(n); count = values.size(); }\n public:\n"
                 "  ReturnType onInitialize() { fill(100); return count == 100 ? OPROS_SUCCESS : 1; }\n};\n"
                 "extern \"C\" {\nComponent* getComponent() { return new Old; }\n"
                 "void releaseComponent(Component* com) { delete com; }\n}\n");
    folder.component("Old/Old", "Old.dll");
    const auto built = build({folder.path() / "Old"});
    INFO(built.output << built.errors);
    REQUIRE(built.exit_code == 0);
    const auto info = tandem_program({"opros", "info", folder.path() / "Old/Old.xml", "--initialize"});
    INFO(info.errors);
    CHECK(info.exit_code == 0);
}

TEST_CASE("a build that takes too long is stopped and leaves the folder unchanged") {
    const Folder folder;
    old_component(folder, "");
    const auto result = build({folder.path() / "Old", "-I", folder.path() / "neighbour", "--timeout", "0.1"});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.errors, Catch::Contains("did not finish within 0.1 s") && Catch::Contains("--timeout"));
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    CHECK(files_in(folder.path() / "Old/profile") == std::vector<std::string>{"Old.xml", "OldService.xml"});
}

TEST_CASE("a component of another platform is built from its makefile's list, with headers in any case") {
    const Folder folder;
    old_component(folder, "");
    folder.write("Old/Old_2009.cpp", "Component* getComponent() { return 0; }\n#error not listed\n");
    folder.write("Old/Makefile", "SRCS = Old.cpp src/Helper.cpp\nCFLAGS = -I../neighbour\n");
    folder.write("Old/Old.h", "#include \"..\\neighbour\\GAIN.h\"\n");
    folder.write("Old/src/Helper.cpp",
                 "#include \"helper.H\"\n#include \"old.h\"\ndouble helped() { return gain(); }\n");
    const auto built = build({folder.path() / "Old"});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(fs::exists(folder.path() / "Old/profile/Old.so"));
}

TEST_CASE("an impossible build is reported in one line with the profile's line, the package or the cause") {
    const Folder folder;
    const auto last_line = [&](std::vector<std::string> arguments) {
        const auto result = build(std::move(arguments));
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        return result.errors;
    };
    old_component(folder, "");
    const std::string old = folder.path() / "Old", neighbour = folder.path() / "neighbour";
    CHECK_THAT(last_line({old}),
               !Catch::Contains("-I DIR") && Catch::Contains("Gain.h: No such file or directory; -I " +
                                                             fs::canonical(neighbour).string()));
    folder.write("neighbour/Gain.h", "#include <cwiid.h>\n");
    if (!fs::exists("/usr/include/cwiid.h"))
        CHECK_THAT(last_line({old, "-I", neighbour}), Catch::Contains("; apt install libcwiid-dev"));
    CHECK_THAT(last_line({old, "--pkg-config", "no_such_module"}),
               Catch::Contains("pkg-config knows no module no_such_module"));
    folder.write("Old/profile/Old.xml",
                 "<component_profile>\n<name>Old</name>\n<oops>\n</component_profile>\n");
    CHECK_THAT(last_line({old}), Catch::Contains("Old.xml:4: not well-formed XML"));
}

TEST_CASE("a relative path for --profile is resolved against the current folder, like other paths") {
    const Folder folder;
    folder.component("One/Second", "Second.dll");
    folder.component("One/Third", "Third.dll");
    folder.write("One/x.cpp", "#include <Component.h>\nextern \"C\" Component* getComponent() { return 0; }\n"
                              "extern \"C\" void releaseComponent(Component*) {}\n");
    const auto here = fs::current_path();
    fs::current_path(folder.path());
    const auto built = build({"One", "--profile", "One/Third.xml"});
    fs::current_path(here);
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(fs::exists(folder.path() / "One/Third.so"));
}

TEST_CASE("copies of a profile are one profile, and different profiles are named with what differs") {
    const Folder folder;
    const std::string one = folder.path() / "One";
    const auto write_profile = [&](const std::string& file, const std::string& library) {
        folder.write(file,
                     "<component_profile><name>One</name><execution_environment><library_name>" + library +
                         "</library_name></execution_environment><execution_semantics><type>passive</type>"
                         "</execution_semantics></component_profile>\n");
    };
    write_profile("One/One.xml", "One.dll");
    write_profile("One/profile/One.xml", "One.dll");
    CHECK_THAT(error_of({one}), Catch::Contains("no C++ source")); // so the profile was found
    folder.write("One/profile/One.xml",
                 "<component_profile><name>One</name><execution_environment><library_name>One.dll"
                 "</library_name></execution_environment><execution_semantics><type>periodic"
                 "</type><period>10</period></execution_semantics></component_profile>\n");
    CHECK_THAT(error_of({one}), Catch::Contains("tandem: One.xml, profile/One.xml, of one library, differ in "
                                                "execution; using the first\n") &&
                                    Catch::Contains("no C++ source"));
    write_profile("One/profile/One.xml", "Other.dll");
    CHECK_THAT(
        error_of({one}),
        Catch::Contains("has several component profiles: One.xml, profile/One.xml; the first two differ in "
                        "<library_name>: One.dll and Other.dll; choose one with --profile FILE"));
}

TEST_CASE("a component of a project with only a program is built without the program's main()") {
    const Folder folder;
    old_component(folder, "\n/* [\nint main() { return 0; }*/\n"); // in a comment: no program
    folder.write("Old/demo.cpp", "//*** starts no comment of several lines\nint not_in_the_plugin();\n"
                                 "int main() { return not_in_the_plugin(); }\n");
    const auto component = folder.path() / "Old";
    folder.write("Old/main.cpp", "int not_in_the_plugin();\nint main() { return not_in_the_plugin(); }\n");
    folder.write("Old/CMakeLists.txt", "cmake_minimum_required(VERSION 3.10)\nproject(Old CXX)\n"
                                       "add_executable(OldProgram Old.cpp src/Helper.cpp main.cpp)\n");
    const std::vector<std::string> arguments{component, "-I", folder.path() / "neighbour"};
    const auto with_project = build(arguments);
    INFO(with_project.output << with_project.errors);
    CHECK(with_project.exit_code == 0);
    fs::remove(component / "CMakeLists.txt");
    CHECK(build(arguments).exit_code == 0);
}

TEST_CASE("the profile of a component may be in the folder above its sources") {
    const Folder folder;
    for (const char* sources : {"One/src", "Two", "Three"}) fs::create_directories(folder.path() / sources);
    folder.component("One/Any", "Any.dll");
    folder.component("Two", "Two.dll");
    CHECK_THAT(error_of({folder.path() / "One/src"}), Catch::Contains("no C++ source"));
    CHECK_THAT(error_of({folder.path() / "Two"}), Catch::Contains("no C++ source"));
    CHECK_THAT(error_of({folder.path() / "Three"}),
               Catch::Contains("no component profile")); // the one in the folder above is Two's
}

// In the style of OPRoS's vision components: OpenCV's C API of 2010.
TEST_CASE(
    "the old headers of OpenCV are found if OpenCV 4 is installed, and its package is named otherwise") {
    const Folder folder;
    folder.write(
        "Eye/Eye.cpp",
        "#include <Component.h>\n#include <cv.h>\n#include <highgui.h>\n"
        "class Eye : public Component {\n  IplImage* image;\n public:\n"
        "  ReturnType onInitialize() {\n"
        "    image = cvCreateImage(cvSize(8, 4), IPL_DEPTH_8U, 1);\n"
        "    cvSet(image, cvScalarAll(7));\n    IplImage* copy = 0;\n"
        "    const bool saved = cvSaveImage(\"eye.png\", image) && (copy = cvLoadImage(\"eye.png\"));\n"
        "    const bool same = saved && copy->nChannels == 3 && cvGet2D(copy, 3, 7).val[2] == 7;\n"
        "    cvReleaseImage(&copy);\n    cvReleaseImage(&image);\n"
        "    return same ? OPROS_SUCCESS : 1;\n  }\n};\n"
        "extern \"C\" {\nComponent* getComponent() { return new Eye; }\n"
        "void releaseComponent(Component* com) { delete com; }\n}\n");
    folder.component("Eye/Eye", "Eye.dll");
    const auto built = build({folder.path() / "Eye"});
    INFO(built.output << built.errors);
    if (!fs::exists("/usr/include/opencv4/opencv2/core/core_c.h")) {
        CHECK(built.exit_code == 1);
        CHECK_THAT(built.errors,
                   Catch::Contains("cv.h: No such file or directory; apt install libopencv-dev"));
        return;
    }
    REQUIRE(built.exit_code == 0);
    const auto here = fs::current_path();
    fs::current_path(folder.path());
    const auto info = tandem_program({"opros", "info", folder.path() / "Eye/Eye.xml", "--initialize"});
    fs::current_path(here);
    INFO(info.errors);
    CHECK(info.exit_code == 0);
    // With the header of OpenCV 2 and 3 that had the C API as well, even before cv.h.
    folder.write("Eye/Eye.cpp", "#include <Component.h>\n#include <opencv2/opencv.hpp>\n"
                                "class Eye : public Component {\n  IplImage* image;\n};\n"
                                "#include <opencv/cv.h>\nint gray() { return CV_GRAY2RGB; }\n"
                                "extern \"C\" {\nComponent* getComponent() { return new Eye; }\n"
                                "void releaseComponent(Component* com) { delete com; }\n}\n");
    const auto with_cpp_header = build({folder.path() / "Eye"});
    INFO(with_cpp_header.output << with_cpp_header.errors);
    CHECK(with_cpp_header.exit_code == 0);
    CHECK_THAT(with_cpp_header.errors, Catch::Contains("including cv.h and highgui.h before each source"));
    folder.write("Eye/Eye.cpp", "#include <cv.h>\nvoid* eye() { return cvHaarDetectObjects(0, 0, 0); }\n");
    CHECK_THAT(build({folder.path() / "Eye"}).errors,
               Catch::Contains("OpenCV 4 no longer has cvHaarDetectObjects"));
}

TEST_CASE("a component in the style of OpenCV 1 writes a video and reads its pictures again") {
    if (!fs::exists("/usr/include/opencv4/opencv2/videoio/videoio_c.h"))
        TANDEM_SKIP("libopencv-dev is not installed");
    const Folder folder;
    folder.write(
        "Eye/Eye.cpp",
        "#include <Component.h>\n#include <cv.h>\n#include <highgui.h>\n"
        "class Eye : public Component {\n public:\n  ReturnType onInitialize() {\n"
        "    CvVideoWriter* writer = cvCreateVideoWriter(\"eye.avi\", CV_FOURCC('M', 'J', 'P', 'G'), 10, "
        "cvSize(64, 32));\n"
        "    IplImage* image = cvCreateImage(cvSize(64, 32), IPL_DEPTH_8U, 3);\n"
        "    cvSet(image, cvScalarAll(200));\n"
        "    for (int i = 0; i < 3; ++i) cvWriteFrame(writer, image);\n"
        "    cvReleaseImage(&image);\n    cvReleaseVideoWriter(&writer);\n"
        "    CvCapture* capture = cvCaptureFromFile(\"eye.avi\");\n    int frames = 0;\n"
        "    while (IplImage* frame = cvQueryFrame(capture))\n"
        "      if (frame->width == 64 && frame->origin == IPL_ORIGIN_TL && cvGet2D(frame, 9, 9).val[1] > "
        "190)\n"
        "        ++frames;\n"
        "    const int width = (int)cvGetCaptureProperty(capture, CV_CAP_PROP_FRAME_WIDTH);\n"
        "    cvReleaseCapture(&capture);\n"
        "    return frames == 3 && width == 64 && !capture && !cvCaptureFromAVI(\"none.avi\") ? "
        "OPROS_SUCCESS "
        ": 1;\n  }\n};\n"
        "extern \"C\" {\nComponent* getComponent() { return new Eye; }\n"
        "void releaseComponent(Component* com) { delete com; }\n}\n");
    folder.component("Eye/Eye", "Eye.dll");
    const auto built = build({folder.path() / "Eye"});
    INFO(built.output << built.errors);
    REQUIRE(built.exit_code == 0);
    const auto here = fs::current_path();
    fs::current_path(folder.path());
    const auto info = tandem_program({"opros", "info", folder.path() / "Eye/Eye.xml", "--initialize"});
    fs::current_path(here);
    INFO(info.errors);
    CHECK(info.exit_code == 0);
}

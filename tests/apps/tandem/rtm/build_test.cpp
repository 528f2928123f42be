// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>

using tandem::test::tandem_program;

namespace {

namespace fs = std::filesystem;

constexpr char module_text[] =
    "#include <rtm/Manager.h>\n"
    "extern \"C\" {\nvoid GoodInit ( RTC::Manager * manager ) { (void)manager; }\n}\n";

std::string failed(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"rtm", "build"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto result = tandem_program(all);
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    return result.errors;
}

} // namespace

TEST_CASE("the sources of an RT-Component must define a module") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    CHECK_THAT(failed({dir}), Catch::Contains("is not a folder"));
    folder.write("Rtc/main.cpp", "void MyModuleInit(RTC::Manager* m);\nint main() {}\n");
    folder.write("Rtc/src/a.cpp", "// void OldInit(RTC::Manager* m);\n/* void OlderInit(RTC::Manager*) */\n"
                                  "void setInit(int); bool BoolInit(RTC::Manager*);\n");
    CHECK_THAT(failed({dir}), Catch::Contains("NAMEInit(RTC::Manager*)") && Catch::Contains("--name"));
    folder.write("Rtc/b.cpp", "void BInit(RTC::Manager *manager) {}\n");
    folder.write("Rtc/c.cpp", "extern \"C\" void CInit(RTC::Manager*) {}\n");
    CHECK_THAT(failed({dir, "--source", "b.cpp"}),
               Catch::Contains("modules B, C") && Catch::Contains("--name"));
    CHECK_THAT(failed({dir, "--name", "no good"}), Catch::Contains("is not a valid component name"));
}

TEST_CASE("the last line of a failed build of an RT-Component is its first error") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    folder.write("Rtc/Good.cpp", module_text);
    folder.write("Rtc/Good.so", "the old one");
    folder.write("Rtc/idl/Broken.idl",
                 "#include \"BasicDataType.idl\"\ninterface Broken { RTC::TimedLung f(); };\n");
    CHECK_THAT(failed({dir}), Catch::Contains("Broken.idl:2:") && Catch::Contains("TimedLung"));
    fs::remove(dir + "/idl/Broken.idl");
    folder.write("Rtc/Good.cpp", std::string("#include \"neighbour.h\"\n") + module_text);
    CHECK_THAT(failed({dir}), Catch::Contains("Good.cpp:1:") && Catch::Contains("neighbour.h"));
    CHECK(fs::file_size(dir + "/Good.so") == 11);

    folder.write("beside/neighbour.h", "int neighbour();\n");
    const auto built = tandem_program({"rtm", "build", dir, "-I", folder.path() / "beside", "--output",
                                       folder.path() / "out", "--standard", "20"});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(fs::exists(folder.path() / "out/Good.so"));
    CHECK(fs::file_size(dir + "/Good.so") == 11);
}

TEST_CASE("a library that git tracks is not replaced without a line about it") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    folder.write("Rtc/Good.cpp", module_text);
    folder.write("Rtc/Good.so", "the old one");
    REQUIRE(tandem::test::shell("git init -q " + folder.path().string()).exit_code == 0);
    CHECK_THAT(tandem_program({"rtm", "build", dir}).errors, !Catch::Contains("git"));
    REQUIRE(tandem::test::shell("git -C " + dir + " add Good.so").exit_code == 0);
    const auto built = tandem_program({"rtm", "build", dir});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK_THAT(built.errors, Catch::Contains("Good.so is tracked by git and is replaced") &&
                                 Catch::Contains("--output DIR"));
    const auto elsewhere = tandem_program({"rtm", "build", dir, "--output", folder.path() / "out"});
    CHECK_THAT(elsewhere.errors, !Catch::Contains("git"));
}

TEST_CASE("temporary files left by an interrupted omniidl are not built") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    folder.write("Rtc/Good.cpp", module_text);
    folder.write("Rtc/omniidl-tmp4711.idl", "# 1 \"Gone.idl\"\ninterface Gone { Lost f(); };\n");
    folder.write("Rtc/idl/omniidl-tmp12.idl", "interface Half {");
    const auto built = tandem_program({"rtm", "build", dir});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(fs::exists(dir + "/Good.so"));
}

// As in repositories with several RT-Components: IDL files in a folder above, sources below neither src/ nor the top, one in C.
TEST_CASE("an RT-Component is built from a sub-folder with the IDL files above it") {
    const Folder folder;
    folder.write("pack/idl/Words.idl", "module pack { typedef sequence<string> Words; };\n");
    folder.write("pack/idl/Greeter.idl", "#include \"Words.idl\"\n"
                                         "module pack { interface Greeter { Words greet(); }; };\n");
    folder.write("pack/rtc/Hello/comp/Hello.cpp",
                 "#include <rtm/Manager.h>\n#include \"pack/idl/GreeterSkel.h\"\n#include \"PART.h\"\n"
                 "extern \"C\" int more(void);\n"
                 "struct Greeter : POA_pack::Greeter {\n"
                 "  pack::Words* greet() { return new pack::Words(part() + more()); }\n};\n"
                 "extern \"C\" void HelloInit(RTC::Manager*) { static Greeter greeter; }\n");
    folder.write("pack/rtc/Hello/comp/Part.cpp", "#include \"part.h\"\nint part() { return 1; }\n");
    folder.write("pack/rtc/Hello/comp/more.c", "int more(void) { int class = 1; return class; }\n");
    folder.write("pack/rtc/Hello/headers/Part.h", "int part();\n");
    const std::string dir = folder.path() / "pack/rtc/Hello";
    const auto built = tandem_program({"rtm", "build", dir});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(built.output == dir + "/Hello.so\n");
}

TEST_CASE("an RT-Component is built with IDL files in sub-folders, including those that only other IDL files "
          "include") {
    const Folder folder;
    const std::string words =
        "#pragma prefix \"example.org\"\nmodule pack { typedef sequence<string> Words; };\n";
    folder.write("Hello/idl/types/Words.idl", words);
    folder.write("Hello/idl/Greeter.idl", "#include \"types/Words.idl\"\n#include \"BasicDataType.idl\"\n"
                                          "module pack { interface Greeter { Words greet(); }; };\n");
    folder.write("Hello/interfaces/v1/Wave.idl", "#include <Shape.idl>\nstruct Wave { Shape form; };\n");
    folder.write("far/Shape.idl", "struct Shape { long sides; };\n");
    folder.write("Hello/Hello.cpp",
                 "#include <rtm/Manager.h>\n#include \"GreeterSkel.h\"\n#include \"v1/WaveStub.h\"\n"
                 "struct Greeter : POA_pack::Greeter {\n"
                 "  pack::Words* greet() { Wave w; return new pack::Words(w.form.sides); }\n};\n"
                 "extern \"C\" void HelloInit(RTC::Manager*) { static Greeter greeter; }\n");
    const std::string dir = folder.path() / "Hello", far = folder.path() / "far";
    const auto built = tandem_program({"rtm", "build", dir, "-I", far});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);

    // A copy in another folder is the same type. Two files of a name would write the same headers.
    folder.write("Hello/Words.idl", words);
    CHECK(tandem_program({"rtm", "build", dir, "-I", far}).exit_code == 0);
    folder.write("Hello/Words.idl", "struct Other { long a; };\n");
    CHECK_THAT(failed({dir, "-I", far}), Catch::Contains("Hello/Words.idl and ") &&
                                             Catch::Contains("types/Words.idl differ") &&
                                             Catch::Contains("rename one"));
}

TEST_CASE("an IDL file in a sub-folder whose name CMake would read as its own language is refused") {
    const Folder folder;
    const std::string dir = folder.path() / "Good";
    folder.write("Good/Good.cpp", std::string("#include \"WaveSkel.h\"\n") + module_text);
    folder.write("Good/deep/a;b/Wave.idl", "struct Wave { long form; };\n");
    CHECK_THAT(failed({dir}), Catch::Contains("a;b/Wave.idl has a ';' in its name"));
    fs::remove_all(dir + "/deep");
    folder.write("Good/deep/Wave.idl", "#include \"a$b.idl\"\nstruct Wave { Shape form; };\n");
    folder.write("Good/deep/a$b.idl", "struct Shape { long sides; };\n");
    CHECK_THAT(failed({dir}), Catch::Contains("Wave.idl includes 'a$b.idl', which CMake or make"));
}

TEST_CASE("an IDL file that is not found is named with the option that adds its folder") {
    const Folder folder;
    const std::string dir = folder.path() / "Good";
    folder.write("Good/Good.cpp", std::string("#include \"Wave.hh\"\n") + module_text);
    folder.write("Good/idl/Wave.idl", "#include \"Shape.idl\"\nstruct Wave { Shape form; };\n");
    CHECK_THAT(failed({dir}), Catch::Contains("Wave.idl:1: Shape.idl: No such file") &&
                                  Catch::Contains("add the folder of Shape.idl with -I DIR"));
    folder.write("Good/deep/down/Shape.idl", "struct Shape { long sides; };\n");
    const std::string down = fs::canonical(dir) / "deep/down";
    CHECK_THAT(failed({dir}), Catch::Contains("; -I " + down + " "));
    const auto built = tandem_program({"rtm", "build", dir, "-I", down});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    fs::rename(dir + "/idl", folder.path() / "elsewhere");
    CHECK_THAT(failed({dir}), Catch::Contains("Good.cpp:1:") && Catch::Contains("Wave.hh"));
    fs::create_directory(folder.path() / ".git");
    const std::string elsewhere = fs::canonical(folder.path()) / "elsewhere";
    CHECK(tandem_program({"rtm", "build", dir, "-I", down}).exit_code == 0); // the only one of its name
    folder.write("old/Wave.idl", "struct Wave { long form; };\n");
    CHECK_THAT(failed({dir, "-I", down}), Catch::Contains("-I " + elsewhere + ", or -I "));
    CHECK(tandem_program({"rtm", "build", dir, "-I", down, "-I", elsewhere}).exit_code == 0);
}

TEST_CASE("the last line names the error of omniidl, whatever it is") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    folder.write("Rtc/Good.cpp", module_text);
    const auto error_of = [&](const std::string& text) {
        folder.write("Rtc/Broken.idl", text);
        return failed({dir});
    };
    CHECK_THAT(
        error_of("interface A { void a(); void A(); };\n"),
        Catch::Contains("Broken.idl:1: Declaration of operation 'a' clashes with name of enclosing scope"));
    CHECK_THAT(error_of("\nconst short k = 70000;\n"),
               Catch::Contains("Broken.idl:2: Value too large for short"));
    CHECK_THAT(error_of("struct A { long a;"),
               Catch::Contains("Broken.idl:1: Instance identifier 'a' clashes"));
    CHECK_THAT(error_of("#error not yet\n"), Catch::Contains("Broken.idl:1: #error not yet"));
    CHECK_THAT(error_of("#if 1\nstruct B { long x; };\n"), Catch::Contains("Broken.idl:1: unterminated"));
    CHECK_THAT(error_of("interface I { void in(in any object); };\n"), Catch::Contains("Broken.idl:1: "));
    // A warning before the error is not the error.
    CHECK_THAT(error_of("interface I { void porttype(); };\nstruct S { Lost l; };\n"),
               Catch::Contains("Broken.idl:2: Error in look-up of 'Lost'"));
}

// A macro decides whether the source is a program or part of a library, as in generated solvers. There are two, as for a robot
// with two arms.
TEST_CASE("a source whose main() is disabled by a macro is built, and one with a main() is not") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    folder.write("Rtc/Good.cpp", std::string("int left();\nint right();\nint sum = left() + right();\n") +
                                     module_text + "#ifdef SELF_TEST\nint main() {}\n#endif\n");
    folder.write("Rtc/src/Left.cpp",
                 "#include <stdio.h>\nint left() { return 1; }\n"
                 "#ifndef SOLVER_NO_MAIN\n#ifdef LOUD\n#endif\nint main()\n{ puts(\"1\"); }\n#endif\n");
    folder.write("Rtc/src/Right.cpp",
                 "#define SOLVER_NO_MAIN\nint right() { return 2; }\n"
                 "#ifndef SOLVER_NO_MAIN\nint main() {}\n#endif\n#ifdef SELF_TEST\nint main() {}\n#endif\n");
    folder.write("Rtc/src/GoodComp.cpp", "#ifdef _WIN32\n#else\nint main(int argc, char** argv) {}\n#endif\n"
                                         "#error this is a program\n");
    const auto built = tandem_program({"rtm", "build", dir});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(tandem::test::shell("nm " + dir + "/Good.so").output.find(" main\n") == std::string::npos);
}

// Two components in the style of the first templates, whose function has the same name in each; what one of their
// libraries hands to its own manager is not a module, nor is what only a header declares.
TEST_CASE("each of several modules in a folder is built from its own sources") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    const auto old_style = [](const std::string& name) {
        return "#include \"Shared.h\"\n"
               "static const char* spec[] = {\"implementation_id\", \"" +
               name +
               "\", \"\"};\nvoid handed(int);\n"
               "extern \"C\" void rtc_init(RTC::Manager* manager) { shared(); (void)spec; }\n";
    };
    folder.write("Rtc/pub_rtc.cpp", old_style("Publisher"));
    folder.write("Rtc/sub_rtc.cpp", old_style("Subscriber"));
    folder.write("Rtc/Shared.h",
                 "namespace RTC { class Manager; }\nvoid shared();\nvoid ElsewhereInit(RTC::Manager*);\n");
    folder.write("Rtc/Shared.cpp",
                 "#include <rtm/Manager.h>\n#include \"Shared.h\"\n"
                 "void MyModuleInit(RTC::Manager* manager) {}\n"
                 "void shared() { RTC::Manager::instance().setModuleInitProc(MyModuleInit); }\n");
    const auto built = tandem_program({"rtm", "build", dir});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(built.output == dir + "/Publisher.so\n" + dir + "/Subscriber.so\n");
    folder.write("Rtc/sub_rtc.cpp", "#error this one is broken\n" + old_style("Subscriber"));
    const auto half = tandem_program({"rtm", "build", dir, "--output", folder.path() / "out"});
    CHECK(half.exit_code == 1);
    CHECK(half.output.find((folder.path() / "out/Publisher.so").string() + "\n") == 0);
    CHECK_THAT(half.errors, Catch::Contains("tandem: component Subscriber does not compile: ") &&
                                Catch::EndsWith("tandem: 1 of the 2 modules in " + dir +
                                                " were not built: Subscriber (see the lines above)\n"));
}

// In the style of projects for Windows and Linux: only CMake's expansion of the macro shows that
// SeveralComp.cpp is a program.
TEST_CASE("an RT-Component is built as its CMake project says, on Linux and without what is missing") {
    const Folder folder;
    const std::string dir = folder.path() / "Several";
    folder.write("Several/CMakeLists.txt",
                 "cmake_minimum_required(VERSION 2.8)\nproject(Several)\nfind_package(OpenRTM REQUIRED)\n"
                 "find_package(NoSuchRobot REQUIRED)\nif(WIN32)\n  set(FLAGS -D__WIN32__ -D__NT__)\nendif()\n"
                 "include_directories(${OPENRTM_INCLUDE_DIRS})\n"
                 "add_definitions(${OPENRTM_CFLAGS} ${FLAGS} -DGAIN=2)\n"
                 "macro(add_rtc_library name)\n  add_library(${name} SHARED ${ARGN})\n"
                 "  target_link_libraries(${name} ${OPENRTM_LIBRARIES} no_such_robot)\n"
                 "  add_executable(${name}Comp ${ARGN} ${name}Comp.cpp)\nendmacro()\n"
                 "add_rtc_library(Several Several.cpp)\n");
    folder.write(
        "Several/Several.cpp",
        "#include <rtm\\Manager.h>\n#include <coil-1.1/coil/Properties.h>\n#include <openrtm-2.0/rtm/RTC.h>\n"
        "#include \".\\parts\\Part.h\"\n#ifdef __WIN32__\n#error for Windows\n#endif\n"
        "extern \"C\" void SeveralInit(RTC::Manager*) { static coil::Properties all; part(GAIN); }\n");
    folder.write("Several/parts/Part.h", "inline int part(int gain) { return gain; }\n");
    folder.write("Several/SeveralComp.cpp", "#define PROGRAM int main()\nPROGRAM { return not_declared; }\n");
    const auto built = tandem_program({"rtm", "build", dir});
    INFO(built.output << built.errors);
    CHECK(built.exit_code == 0);
    CHECK(built.output == dir + "/Several.so\n");
    folder.write("Several/Several.cpp",
                 "#include <robot/NoSuch.h>\nextern \"C\" void SeveralInit(RTC::Manager*) {}\n");
    CHECK_THAT(failed({dir}),
               Catch::Contains("NoSuch.h") &&
                   Catch::Contains("CMakeLists.txt requires packages that were not found: NoSuchRobot"));
}

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

// As generated solvers have it: a program or a part of a library, by a macro; two of them, as a robot with two arms has.
TEST_CASE("a source whose main() is disabled by a macro is built, and one with a main() is not") {
    const Folder folder;
    const std::string dir = folder.path() / "Rtc";
    folder.write("Rtc/Good.cpp",
                 std::string("int left();\nint right();\nint sum = left() + right();\n") + module_text);
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
// libraries hands to its own manager is no module, nor is what only a header declares.
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

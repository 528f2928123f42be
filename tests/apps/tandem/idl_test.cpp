// SPDX-License-Identifier: Apache-2.0
// tandem idl2opros and opros2idl: what they write compiles, and says the same in both directions.
#include "host/process/run_command.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

using tandem::test::CommandOutput;

namespace {

namespace fs = std::filesystem;

const char* const arm_idl = R"(
#include "rtm/idl/BasicDataType.idl"
module Robot {
  enum Mode { idle, running };
  struct Pose { double x; long cells[4]; Mode how; };
  typedef sequence<Pose> Path;
  typedef double Triple[3];
  struct Tree;
  typedef sequence<Tree> Trees;
  struct Tree { long value; Trees branches; };
  union Either switch(boolean) { case TRUE: long number; case FALSE: string text; };
  union Goal switch(Mode) { case running: Pose end; case idle: double cells[2]; };
  union Key switch(char) { case 'a': case 'b': octet small; default: Either other; };
  exception Blocked { string joint; };
  exception Uprooted { Tree what; };
  typedef fixed<5, 2> Price;
  union Wide switch (unsigned long long) { case 18446744073709551615: wstring text; case 1: Price cost; };
  interface Base { readonly attribute string name; attribute double speed; };
  interface Arm : Base {
    boolean move(in Path along, inout Pose last, out string text) raises (Blocked);
    void place(in Triple where, in RTC::Time when);
    oneway void stop();
    void grow(in Tree what);
    void choose(in Either which, inout Goal aim, out Key found);
    any wrap(in wchar letter, in wstring text, in long double number, in Price cost, in Wide which);
    void uproot() raises (Uprooted);
  };
};
)";

const char* const service_xml = R"(<service_port_type_profile><service_port_type>
  <type_name>Arm</type_name>
  <method name="move" return_type="ReturnType" call_type="blocking">
    <param index="1"><type>const std::vector&lt;std::valarray&lt;double&gt; &gt;&amp;</type><name>path</name></param>
    <param index="2"><type>Pose*</type><name>in</name></param>
    <param index="3"><type>std::map&lt;std::string, unsigned int&gt;</type><name>limits</name></param>
  </method>
  <method name="stop" return_type="void" call_type="nonblocking"/>
</service_port_type></service_port_type_profile>
)";
const char* const pose_xml = R"(<data_type><struct name="Pose"><item type="double">x</item>
  <item type="vector&lt;long&gt;">cells</item></struct></data_type>
)";

/// A folder with files, and commands that run in it.
struct IdlFolder : Folder {
    std::string read(const std::string& name) const {
        std::ifstream file(path() / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    CommandOutput run(const std::string& command) const {
        return tandem::test::shell("cd " + path().string() + " && " + command);
    }
};

const std::string program = TANDEM_PROGRAM;

} // namespace

TEST_CASE("idl2opros writes headers that compile, and names operations without a counterpart") {
    const IdlFolder folder;
    folder.write("Arm.idl", arm_idl);
    const auto made = folder.run(program + " idl2opros Arm.idl -o out");
    INFO(made.output);
    REQUIRE(made.exit_code == 0);
    CHECK_THAT(
        made.output,
        Catch::Contains("Arm.idl: 2 interfaces, 11 methods, 2 operations left out") &&
            Catch::Contains("Robot::Arm.grow is left out: argument 'what': Robot::Tree contains itself") &&
            Catch::Contains(
                "Robot::Arm.uproot is left out: exception Robot::Uprooted: Robot::Tree contains itself"));
    const auto profile = folder.read("out/ArmService.xml");
    CHECK_THAT(profile,
               Catch::Contains("<method name=\"stop\" return_type=\"void\" call_type=\"nonblocking\"/>") &&
                   Catch::Contains("<param index=\"2\"><type>Robot::Pose&amp;</type><name>last</name>") &&
                   Catch::Contains("name=\"setSpeed\"") && !Catch::Contains("name=\"setName\""));
    folder.write("use.cpp",
                 "#include \"ArmProvided.h\"\n#include \"ArmRequired.h\"\n#include \"BaseRequired.h\"\n"
                 "bool use(ArmRequired& arm, ArmProvided& provided) {\n"
                 "    Robot::Pose last; std::string text; Robot::Triple where;\n"
                 "    arm.place(where, RTC::Time());\n"
                 "    Robot::Either which; which._d = true; which.number = 3;\n"
                 "    Robot::Goal goal; goal._d = Robot::running; goal.end = last; goal.cells[1] = 2;\n"
                 "    Robot::Wide wide; wide._d = 1; wide.cost = \"1.25\";\n"
                 "    idl::any any = arm.wrap(L'x', L\"text\", 0.5L, wide.cost, wide);\n"
                 "    text = any.type;\n"
                 "    Robot::Key key; arm.choose(which, goal, key); key.other = which;\n"
                 "    return arm.move({last}, last, text) && provided.getMethod(\"stop\");\n}\n");
    const auto compiled =
        folder.run("c++ -std=c++14 -Wall -Werror -fsyntax-only -Iout -I" OPROS_HEADERS " use.cpp");
    INFO(compiled.output);
    CHECK(compiled.exit_code == 0);
    CHECK(folder.run(program + " opros info out/ArmService.xml").exit_code == 0);
}

TEST_CASE("idl2opros ends with omniidl's error if the IDL is invalid") {
    const IdlFolder folder;
    folder.write("Wrong.idl", "interface I { void f(in Nothing n); };\n");
    const auto made = folder.run(program + " idl2opros Wrong.idl");
    CHECK(made.exit_code == 1);
    CHECK_THAT(made.output, Catch::Contains("tandem: omniidl: ") && Catch::Contains("Wrong.idl:1"));
    CHECK_THAT(folder.run(program + " idl2opros None.idl").output,
               Catch::Contains("file None.idl does not exist"));
}

TEST_CASE("names that omniidl's shell would interpret are refused, and others work") {
    const IdlFolder folder;
    folder.write("Arm.idl", "interface Arm { void stop(); };\n");
    const auto run = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {program, "idl2opros"});
        return tandem::process::run_command(arguments, {.folder = folder.path().string()});
    };
    for (const char* name : {"a$(touch marker)", "a`touch marker`", "a\"b", "a\\", "a\nb"}) {
        fs::create_directory(folder.path() / name);
        fs::copy_file(folder.path() / "Arm.idl", folder.path() / name / "Arm.idl");
        for (const auto& result : {run({std::string(name) + "/Arm.idl"}), run({"Arm.idl", "-I", name})}) {
            CHECK(result.exit_code() == 1);
            CHECK_THAT(result.errors, Catch::Contains(" in its name, which omniidl does not read"));
            CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        }
    }
    for (const char* name : {"-rf", "a b", "a'b", "a;b", "a#b", "é"}) {
        fs::create_directory(folder.path() / name);
        fs::copy_file(folder.path() / "Arm.idl", folder.path() / name / "Arm.idl");
        const auto result =
            run({std::string("./") + name + "/Arm.idl", std::string("-I") + name, "-o", name});
        CHECK(result.errors.empty());
        CHECK(result.output == "Arm.idl: 1 interfaces, 1 methods, 0 operations left out\n");
        CHECK(fs::exists(folder.path() / name / "IArm.h"));
    }
    CHECK_FALSE(fs::exists(folder.path() / "marker"));
}

TEST_CASE("opros2idl writes IDL that omniidl and idl2opros accept") {
    const IdlFolder folder;
    folder.write("ArmService.xml", service_xml);
    folder.write("pose.xml", pose_xml);
    const auto made = folder.run(program + " opros2idl ArmService.xml --types pose.xml -o Arm.idl");
    INFO(made.output);
    REQUIRE(made.exit_code == 0);
    const auto idl = folder.read("Arm.idl");
    CHECK_THAT(idl, Catch::Contains("long move(in ::ArmTypes::DoubleSeqSeq path, inout ::ArmTypes::Pose _in, "
                                    "in ::ArmTypes::StringUnsignedLongPairSeq limits);") &&
                        Catch::Contains("oneway void stop();") &&
                        Catch::Contains("struct Pose { double x; ::ArmTypes::LongLongSeq cells; };"));
    CHECK(folder.run("omniidl -bcxx Arm.idl").exit_code == 0);
    const auto back = folder.run(program + " idl2opros Arm.idl");
    CHECK_THAT(back.output, Catch::Contains("Arm.idl: 1 interfaces, 2 methods, 0 operations left out"));
}

TEST_CASE("an IDL that went through idl2opros and opros2idl has the same operations and types") {
    const IdlFolder folder;
    folder.write("Cell.idl", R"(
#include "rtm/idl/BasicDataType.idl"
#include "Common.idl"
module Cell {
  enum Mode { idle, running };
  struct Pose { double x; long cells[4][2]; Mode how; };
  typedef sequence<Pose> Path;
  typedef sequence<Path> Paths;
  typedef double Triple[3];
  union Either switch (boolean) { case TRUE: long number; case FALSE: string text; };
  union Goal switch (Mode) { case running: Pose end; case idle: double cells[2]; };
  union Key switch (char) { case 'a': case 'b': octet small; case '\'': Path way; default: Either other; };
  union Size switch (short) { case -1: case 7: float length; };
  typedef fixed<9, 3> Fixed9_3;
  typedef sequence<wchar> WcharSeq;
  union Wide switch (unsigned long long) { case 18446744073709551615: wstring text; default: long double number; };
  struct Anything { any value; };
  exception Blocked { string joint; Goal aim; Paths tried; any cause; };
  exception Empty {};
  module Other { struct Pose { float y; }; typedef sequence<Pose> Path; };
  interface Base { readonly attribute string name; attribute double speed; };
  interface Robot : Base {
    struct Part { long long id; unsigned short kind; };
    typedef sequence<Part> Parts;
    exception Missing { Parts which; };
    boolean move(in Path along, inout Pose last, out string text) raises (Blocked, Empty, Missing);
    Parts part_list(in Other::Path others, in Paths all, out Key found, inout Size _in);
    void place(in Triple where, in RTC::Time when, in RTC::TimedDoubleSeq numbers);
    Either choose(in Goal which, in char letter, in octet small, in unsigned long long long_number);
    Fixed9_3 price(in wchar letter, inout wstring text, out long double number, in WcharSeq letters);
    any wrap(in Anything what, in Wide which) raises (Common::Late);
    oneway void stop();
  };
};
)");
    folder.write("Common.idl", "module Common { exception Late { fixed<9, 3> by; }; };\n");
    REQUIRE(folder.run(program + " idl2opros Cell.idl -o out").exit_code == 0);
    const auto made =
        folder.run(program + " opros2idl out/RobotService.xml --types out/CellTypes.xml -o Back.idl");
    INFO(made.output);
    REQUIRE(made.exit_code == 0);
    // Base is a separate interface there.
    REQUIRE(folder.run(program + " opros2idl out/BaseService.xml -o Base.idl").exit_code == 0);
    const auto outline = [&](const std::string& file) {
        return folder.run("PYTHONDONTWRITEBYTECODE=1 omniidl -nf -p" TANDEM_TEST_SOURCES
                          " -bidl_outline -I$(dirname $(dirname " +
                          program + "))/host/rtm/include " + file);
    };
    const auto before = outline("Cell.idl"), robot = outline("Back.idl"), base = outline("Base.idl");
    INFO(before.output << robot.output << folder.read("Back.idl"));
    REQUIRE(before.exit_code == 0);
    REQUIRE(robot.exit_code == 0);
    CHECK_THAT(before.output, Catch::Contains("Cell::Robot: ") && Catch::Contains("union Cell::Key"));
    std::string without_base;
    std::istringstream lines(before.output);
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("Cell::Base")) without_base += line + "\n";
    CHECK(robot.output == without_base);
    CHECK_THAT(base.output,
               Catch::Contains("Cell::Base: attribute") && Catch::Contains("Cell::Base: readonly attribute"));
}

TEST_CASE("opros2idl escapes the keywords of CORBA's component model, which omniidl warns of") {
    const IdlFolder folder;
    folder.write("Drive.xml", R"(<service_port_type_profile><service_port_type><type_name>Drive</type_name>
  <method name="import" return_type="void" call_type="blocking">
    <param index="1"><type>Pose</type><name>Home</name></param></method>
</service_port_type></service_port_type_profile>
)");
    folder.write(
        "pose.xml",
        R"(<data_type><struct name="Pose"><item type="double">component</item></struct></data_type>)");
    const auto made = folder.run(program + " opros2idl Drive.xml --types pose.xml -o Drive.idl");
    INFO(made.output);
    REQUIRE(made.exit_code == 0);
    CHECK_THAT(folder.read("Drive.idl"), Catch::Contains("double _component;") &&
                                             Catch::Contains("void _import(in ::DriveTypes::Pose _Home)"));
    const auto read = folder.run("omniidl -bcxx Drive.idl 2>&1");
    CHECK(read.exit_code == 0);
    CHECK(read.output == "");
}

TEST_CASE("opros2idl names the file and line of an unknown type") {
    const IdlFolder folder;
    folder.write("ArmService.xml", service_xml);
    const auto made = folder.run(program + " opros2idl ArmService.xml");
    CHECK(made.exit_code == 1);
    CHECK_THAT(made.output, Catch::Contains("ArmService.xml:3") && Catch::Contains("'move'") &&
                                Catch::Contains("type 'Pose' is unknown; give the data type profile") &&
                                Catch::Contains("--types"));
}

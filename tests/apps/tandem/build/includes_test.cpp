// SPDX-License-Identifier: Apache-2.0
// Names in #include lines that no include folder has.
#include "apps/tandem/build/include_scan.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

using namespace tandem::command;

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

} // namespace

TEST_CASE("headers with a version of OpenRTM in their path, or backslashes, are those of the runtime") {
    const Folder folder;
    folder.write("Arm/Arm.cpp", "#include <coil-2.0/coil/Time.h>\n#include <openrtm-1.1/rtm/Manager.h>\n"
                                "#include <rtm-2.0/rtm/idl/BasicDataTypeSkel.h>\n#include <rtm\\RTC.h>\n"
                                "#include <coil-1.2\\coil\\Mutex.h>\n#include \"..\\common\\Units.h\"\n"
                                "#include <rtm/Manager.h>\n#include <robot-2.0/robot.h>\n");
    folder.write("common/Units.h", "");
    const auto scan = scan_includes(folder.path() / "Arm", {folder.path() / "Arm/Arm.cpp"}, {});
    CHECK(scan.forwards == std::map<std::string, std::string>{
                               {"coil-2.0/coil/Time.h", "coil/Time.h"},
                               {"openrtm-1.1/rtm/Manager.h", "rtm/Manager.h"},
                               {"rtm-2.0/rtm/idl/BasicDataTypeSkel.h", "rtm/idl/BasicDataTypeSkel.h"},
                               {"rtm\\RTC.h", "rtm/RTC.h"},
                               {"coil-1.2\\coil\\Mutex.h", "coil/Mutex.h"},
                               {"..\\common\\Units.h", folder.path() / "common/Units.h"}});
    const auto written = write_forwards(scan.forwards, folder.path() / "forwards");
    CHECK(text_of(written / "rtm\\RTC.h") == "#include <rtm/RTC.h>\n");
    CHECK(text_of(written / "coil-2.0/coil/Time.h") == "#include <coil/Time.h>\n");
}

TEST_CASE("a header on a drive of Windows is the one below the last folder named include, or else the one of "
          "its name") {
    const Folder folder;
    folder.write("Arm/Arm.cpp", "#include \"C:\\Program Files (x86)/Eigen\\include/eigen3/Eigen/Core\"\n"
                                "#include \"D:\\work\\Arm\\Units.h\"\n"
                                "#include <C:/OpenRTM/include/coil-1.1/coil/Time.h>\n"
                                "#include <C:/include/coil/Mutex.h>\n");
    folder.write("Arm/parts/Units.h", "");
    const auto scan = scan_includes(folder.path() / "Arm", {folder.path() / "Arm/Arm.cpp"}, {});
    CHECK(scan.forwards ==
          std::map<std::string, std::string>{
              {"C:\\Program Files (x86)/Eigen\\include/eigen3/Eigen/Core", "eigen3/Eigen/Core"},
              {"D:\\work\\Arm\\Units.h", "Units.h"},
              {"Units.h", folder.path() / "Arm/parts/Units.h"},
              {"C:/OpenRTM/include/coil-1.1/coil/Time.h", "coil/Time.h"},
              {"C:/include/coil/Mutex.h", "coil/Mutex.h"}});
    CHECK(scan.pkg_config == std::set<std::string>{"eigen3"});
}

TEST_CASE("a neighbour of a header may be the IDL file that it is made from") {
    const Folder folder;
    folder.write("Arm/Arm.cpp", "#include <hand/idl/Grip.hh>\n#include \"PalmStub.h\"\n");
    folder.write("hand/idl/Grip.idl", "");
    const auto grip = folder.path() / "hand/idl/Grip.idl";
    const auto scan = scan_includes(folder.path() / "Arm", {folder.path() / "Arm/Arm.cpp"}, {},
                                    {{"hand/idl/Grip.hh", grip}, {"PalmStub.h", "/hands/Palm.idl"}});
    CHECK(scan.forwards == std::map<std::string, std::string>{{"hand/idl/Grip.hh", "Grip.hh"}});
    CHECK(scan.idl_files == std::vector<fs::path>{grip, "/hands/Palm.idl"});
}

// RTCBuilder creates test components in this form; it treats every IDL file as one with services.
TEST_CASE("an implementation of services that an IDL file does not have is the header of its data types") {
    const Folder folder;
    folder.write("Arm/idl/Path.idl", "// interface\nstruct Path { sequence<double> node; };\n");
    folder.write("Arm/idl/Grip.idl", "module Hand{interface Grip {};};\n");
    folder.write("Arm/test/Test.cpp", "#include \"BasicDataTypeSVC_impl.h\"\n#include \"PathSVC_impl.h\"\n"
                                      "#include \"GripSVC_impl.h\"\n#include \"NowhereSVC_impl.h\"\n");
    const auto test = folder.path() / "Arm/test";
    const auto scan = scan_includes(test, {test / "Test.cpp"}, {});
    CHECK(scan.forwards ==
          std::map<std::string, std::string>{{"BasicDataTypeSVC_impl.h", "rtm/idl/BasicDataTypeSkel.h"},
                                             {"PathSVC_impl.h", "PathSkel.h"}});
    CHECK(scan.idl_files == std::vector<fs::path>{folder.path() / "Arm/idl/Path.idl"});
}

// As in repositories that contain the headers of OPRoS and further devices beside them.
TEST_CASE("a header below a copy of the OPRoS headers includes those of Tandem, not the copy") {
    const Folder folder;
    folder.write("library/include/Component.h", "#error not this copy\n");
    const std::string device = "#include \"ApiTypes.h\"\nclass Claw;\n";
    folder.write("library/include/device/Claw.h", device);
    folder.write("own/Claw.h", "");
    const auto written = write_forwards({{"Claw.h", folder.path() / "library/include/device/Claw.h"},
                                         {"own.h", folder.path() / "own/Claw.h"}},
                                        folder.path() / "forwards");
    CHECK(text_of(written / "Claw.h") == device);
    CHECK(text_of(written / "own.h") == "#include \"" + (folder.path() / "own/Claw.h").string() + "\"\n");
}

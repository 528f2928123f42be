// SPDX-License-Identifier: Apache-2.0
// The installed tree, moved after its installation, and what the build systems of RT-Components ask of it.
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

using tandem::test::shell;

namespace {

namespace fs = std::filesystem;

std::string run(const std::string& command) {
    const auto said = shell("timeout 250 " + command);
    INFO(command << "\n" << said.output);
    REQUIRE(said.exit_code == 0);
    return said.output;
}

// A folder with the tree in moved/.
struct Installed {
    Folder folder;
    std::string moved = folder.path() / "moved", bin = moved + "/bin/";

    Installed() {
        run("cmake --install " BUILD_TREE " --component rtm --prefix " + (folder.path() / "first").string());
        fs::rename(folder.path() / "first", moved);
    }
    std::string at(const std::string& name) const { return folder.path() / name; }
};

// Waits until the component has printed `expected`, because its first onExecute may follow the host's `ready`.
tandem::test::CommandOutput until_printed(const std::string& command, const std::string& expected) {
    const auto said = tandem::test::run_host(command, "", expected);
    INFO(command << "\n" << said.output);
    CHECK_THAT(said.output, Catch::Contains(expected));
    return said;
}

void host_runs(const std::string& command, const std::string& expected) {
    CHECK(until_printed(command, expected).exit_code == 0);
}

// The manager handles signals only from runManager() on, which may follow the component's text; before that, the exit code is
// 143.
void program_runs(const std::string& command, const std::string& expected) {
    const int code = until_printed(command, expected).exit_code;
    CHECK((code == 0 || code == 143));
}

} // namespace

TEST_CASE("a project in the layout of RTCBuilder builds unchanged with a moved installation and runs") {
    const Installed tree;
    const std::string project = tree.at("Dictionary"), build = tree.at("build");
    fs::copy(PROJECT, project, fs::copy_options::recursive);
    // Neither a `python` nor a doxygen on the path of this shell, as on a Debian that has only what Tandem
    // asks for.
    const std::string plain = "env PATH=/usr/bin:/bin ";
    run(plain + "cmake -S " + project + " -B " + build +
        " -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS=" SANITIZER_FLAGS " -DOpenRTM_DIR=" + tree.moved +
        "/" LIBDIR "/cmake/OpenRTM");
    run(plain + "cmake --build " + build + " --parallel 2");
    const std::string found = "Dictionary0 found robot!, asked 1 time";
    program_runs(build + "/src/DictionaryComp -f " + project + "/rtc.conf", found);
    host_runs(tree.bin + "rtm_host -f " + project + "/rtc.conf -o manager.modules.load_path:" + build +
                  "/src -o manager.modules.preload:Dictionary.so -o manager.components.precreate:Dictionary",
              found);
    run("cmake --install " + build + " --prefix " + tree.at("installed"));
    program_runs(tree.at("installed/share/openrtm-2.1/components/DictionaryComp -f ") + project + "/rtc.conf",
                 found);
    // Bridges know its services.
    CHECK_THAT(run("nm -DC " + build + "/src/Dictionary.so"), Catch::Contains("RTC::InterfaceSignatures"));

    // Builds the same folder without its project files; its own program is left out.
    run(tree.bin + "tandem rtm build " + project);
    host_runs(tree.bin + "rtm_host -f " + project +
                  "/rtc.conf -o manager.modules.preload:Dictionary.so "
                  "-o manager.components.precreate:Dictionary",
              found);
}

TEST_CASE("a component made by tandem rtm new builds with find_package and with tandem rtm build and runs") {
    const Installed tree;
    const std::string arm = tree.at("Arm");
    run(tree.bin + "tandem rtm new Arm --in " + tree.folder.path().string());
    run("cmake -S " + arm + " -B " + arm + "/build -DCMAKE_PREFIX_PATH=" + tree.moved);
    run("cmake --build " + arm + "/build");
    host_runs(tree.bin + "rtm_host -f " + arm + "/rtc.conf", "Arm0: activated, gain 2");
    CHECK_THAT(shell(tree.bin + "tandem rtm new Arm --in " + tree.folder.path().string()).output,
               Catch::Contains("Arm exists"));
    fs::remove(arm + "/Arm.so");
    fs::remove_all(arm + "/build");

    // A partly built tree may lack the libraries that few components need.
    for (const std::string library : {"Camera", "Manipulator"})
        fs::remove(tree.moved + "/" LIBDIR "/librtm" + library + "2.so");
    CHECK(run(tree.bin + "tandem rtm build " + arm) == arm + "/Arm.so\n");
    host_runs(tree.bin + "rtm_host -f " + arm + "/rtc.conf", "Arm0: activated, gain 2");
    run("cmake -S " + arm + " -B " + arm + "/build -DCMAKE_PREFIX_PATH=" + tree.moved);
}

TEST_CASE("rtm-config and pkg-config work in a moved installation, and no file contains the old path") {
    const Installed tree;
    const std::string config = tree.bin + "rtm-config ";
    CHECK(run(config + "--prefix --version --orb") == tree.moved + "\n2.1.0\nomniORB\n");
    const auto idl = run(config + "--rtm-idldir");
    CHECK(fs::exists(fs::path(idl.substr(0, idl.size() - 1)) / "BasicDataType.idl"));
    CHECK(run(tree.bin + "rtm2-config --libs") == run(config + "--libs"));
    const auto wrong = shell(config + "--wings");
    CHECK(wrong.exit_code == 1);
    CHECK_THAT(wrong.output, Catch::Contains("unknown option --wings"));
    // Makefiles of rtc-template use it in this way.
    tree.folder.write("x.cpp",
                      "#include <CameraCommonInterfaceSkel.h>\n#include <rtm/Manager.h>\n"
                      "int main() { return RTC::Manager::init(0, 0) == 0 || !Img::_tc_TimedCameraImage; }\n");
    run("bash -c \"c++ " + tree.at("x.cpp") + " -o " + tree.at("x") + " $(" + config +
        "--cflags --libs | tr \"\\n\" \" \")\"");
    // A user's IDL that includes the camera's, which is beside the data types as in OpenRTM-aist 2.x.
    tree.folder.write("Eye.idl", "#include \"CameraCommonInterface.idl\"\n"
                                 "struct Eye { Img::CameraImage seen; };\n");
    run("bash -c \"cd " + tree.at("") + " && omniidl $(" + config + "--idlflags | tr \"\\n\" \" \") -I$(" +
        config + "--rtm-idldir) Eye.idl\"");
    tree.folder.write("eye.cpp", "#include <rtm/idl/CameraCommonInterfaceUtil.h>\n#include \"Eye.hh\"\n"
                                 "int main() { return Eye().seen.image.raw_data.length(); }\n");
    run("bash -c \"c++ -c " + tree.at("eye.cpp") + " -o " + tree.at("eye.o") + " $(" + config +
        "--cflags | tr \"\\n\" \" \")\"");
    const auto needed = run("readelf -d " + tree.at("x"));
    CHECK_THAT(needed, Catch::Contains("librtmCamera2.so") && !Catch::Contains("librtmManipulator2.so"));
    for (const std::string package : {"openrtm-aist", "openrtm2"})
        CHECK_THAT(
            run("env PKG_CONFIG_PATH=" + tree.moved + "/" LIBDIR "/pkgconfig pkg-config --cflags " + package),
            Catch::Contains("include/tandem/rtm"));
    CHECK(shell("grep -rlI " + tree.at("first") + " " + tree.moved).output.empty());
    CHECK(shell("grep -rlI " BUILD_TREE " " + tree.moved).output.empty());

    tree.folder.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.16)\nproject(x CXX)\n"
                                        "find_package(OpenRTM-aist 1.1 REQUIRED)\n"
                                        "message(STATUS version=${OPENRTM_VERSION})\n");
    CHECK_THAT(run("cmake -S " + tree.folder.path().string() + " -B " + tree.at("b") +
                   " -DCMAKE_PREFIX_PATH=" + tree.moved),
               Catch::Contains("version=2.1.0"));
}

TEST_CASE("a project with its own OpenRTM finder that requires Doxygen builds with the remedy of the page") {
    const Installed tree;
    tree.folder.write("FindOpenRTM.cmake", "find_package(PkgConfig REQUIRED)\n"
                                           "pkg_check_modules(OPENRTM REQUIRED openrtm-aist)\n");
    tree.folder.write("Doxyfile", "HTML_OUTPUT = pages\n");
    tree.folder.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.16)\nproject(x CXX)\n"
                                        "set(CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR})\n"
                                        "find_package(OpenRTM REQUIRED)\n"
                                        "find_package(Doxygen)\n"
                                        "if(NOT DOXYGEN_FOUND)\n"
                                        "  message(FATAL_ERROR \"Doxygen was not found.\")\n"
                                        "endif()\n"
                                        "add_custom_target(doc ALL ${DOXYGEN_EXECUTABLE} Doxyfile\n"
                                        "  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})\n"
                                        "install(DIRECTORY pages DESTINATION doc)\n");
    const std::string environment = "env PATH=" + tree.bin + ":/usr/bin:/bin:" + tree.moved +
                                    "/share/tandem/rtm/stand-ins PKG_CONFIG_PATH=" + tree.moved +
                                    "/" LIBDIR "/pkgconfig ";
    run(environment + "cmake -S " + tree.folder.path().string() + " -B " + tree.at("b"));
    run(environment + "cmake --build " + tree.at("b"));
    run(environment + "cmake --install " + tree.at("b") + " --prefix " + tree.at("installed"));
    CHECK(fs::is_directory(tree.at("installed/doc/pages")));
}

TEST_CASE("a package of catkin with rtmbuild builds without ROS and its component runs") {
    const Installed tree;
    tree.folder.write("hello/package.xml",
                      "<package><name>hello</name><depend>rtmbuild</depend></package>\n");
    tree.folder.write("hello/CMakeLists.txt",
                      "cmake_minimum_required(VERSION 3.0.2)\nproject(hello)\n"
                      "find_package(catkin REQUIRED COMPONENTS rtmbuild)\nrtmbuild_init()\n"
                      "catkin_package(LIBRARIES GreeterSkel)\nrtmbuild_genidl()\n"
                      "add_subdirectory(rtc)\n");
    tree.folder.write(
        "hello/rtc/CMakeLists.txt",
        "include_directories(${catkin_INCLUDE_DIRS})\nrtmbuild_add_library(Hello SHARED Hello.cpp)\n"
        "target_link_libraries(Hello ${catkin_LIBRARIES})\n"
        "set_target_properties(Hello PROPERTIES PREFIX \"\")\n"
        "add_dependencies(Hello RTMBUILD_${PROJECT_NAME}_genrpc)\n"
        "rtmbuild_add_executable(HelloComp HelloComp.cpp)\ntarget_link_libraries(HelloComp Hello)\n");
    tree.folder.write("hello/idl/Greeter.idl", "module hello { interface Greeter { string greet(); }; };\n");
    tree.folder.write("hello/rtc/HelloComp.cpp",
                      "#include <rtm/Manager.h>\nextern \"C\" void HelloInit(RTC::Manager*);\n"
                      "int main(int c, char** v) { HelloInit(RTC::Manager::init(c, v)); }\n");
    tree.folder.write(
        "hello/rtc/Hello.cpp",
        "#include <iostream>\n#include <rtm/DataFlowComponentBase.h>\n#include <rtm/Manager.h>\n"
        "#include \"hello/idl/Greeter.hh\"\n"
        "struct Greeter : POA_hello::Greeter {\n"
        "  char* greet() throw(CORBA::SystemException) { return CORBA::string_dup(\"hello\"); }\n};\n"
        "struct Hello : RTC::DataFlowComponentBase {\n"
        "  Hello(RTC::Manager* m) : RTC::DataFlowComponentBase(m) {}\n"
        "  RTC::ReturnCode_t onInitialize() {\n"
        "    std::cout << CORBA::String_var(Greeter().greet()) << \" from catkin\" << std::endl;\n"
        "    return RTC::RTC_OK;\n  }\n};\n"
        "const char* spec[] = {\"implementation_id\", \"Hello\", \"type_name\", \"Hello\", \"\"};\n"
        "extern \"C\" void HelloInit(RTC::Manager* m) {\n"
        "  coil::Properties profile(spec);\n"
        "  m->registerFactory(profile, RTC::Create<Hello>, RTC::Delete<Hello>);\n}\n");
    const std::string package = " -Dcatkin_DIR=" + tree.moved + "/" LIBDIR "/cmake/Tandem/catkin";
    run("cmake -S " + tree.at("hello") + " -B " + tree.at("b") + package +
        " -DCMAKE_CXX_FLAGS=" SANITIZER_FLAGS);
    run("cmake --build " + tree.at("b") + " --parallel 2");
    const std::string precreate = " -o manager.components.precreate:Hello";
    host_runs(tree.bin + "rtm_host -o manager.modules.preload:" + tree.at("b/rtc/Hello.so") + precreate,
              "hello from catkin");
    // Builds the same folder with the plain command.
    run(tree.bin + "tandem rtm build " + tree.at("hello"));
    host_runs(tree.bin + "rtm_host -o manager.modules.preload:" + tree.at("hello/Hello.so") + precreate,
              "hello from catkin");
    tree.folder.write("ros/CMakeLists.txt",
                      "cmake_minimum_required(VERSION 3.0.2)\nproject(ros)\n"
                      "find_package(catkin REQUIRED COMPONENTS rtmbuild some_msgs)\nrtmbuild_init()\n"
                      "message(STATUS \"${catkin_INCLUDE_DIRS} and ${catkin_LIBRARIES}.\")\n");
    const std::string configure = "cmake -S " + tree.at("ros") + " -B " + tree.at("ros/b") + package;
    const auto refused = shell(configure);
    CHECK(refused.exit_code != 0);
    CHECK_THAT(refused.output, Catch::Contains("needs \x27some_msgs\x27 of ROS, which is not installed") &&
                                   Catch::Contains("apt install libsome-msgs-dev"));
    // In the form in which Debian's packages of ROS list their contents.
    tree.folder.write("debian/share/some_msgs/cmake/some_msgsConfig.cmake",
                      "set(some_msgs_INCLUDE_DIRS /of/some)\nset(some_msgs_LIBRARIES some.so)\n");
    CHECK_THAT(run(configure + " -DCMAKE_PREFIX_PATH=" + tree.at("debian")),
               Catch::Contains("devel/include;/of/some and some.so."));
}

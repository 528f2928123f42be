// SPDX-License-Identifier: Apache-2.0
// What `tandem opros build` and `tandem rtm build` know about packages of Debian, and use of those installed.
#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/packages/header_packages.hpp"
#include "apps/tandem/build/packages/installed_library.hpp"
#include "apps/tandem/build/packages/missing_libraries.hpp"
#include "apps/tandem/build/project/cmake_projects.hpp"
#include "apps/tandem/build/remedy.hpp"
#include "apps/tandem/build/select_sources.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

using namespace tandem::command;

namespace {

namespace fs = std::filesystem;

// Returns "package module folder".
std::string package_of(const std::string& header) {
    const auto found = find_package_of_header(header);
    if (!found) return "";
    return std::string(found->package) + " " + std::string(found->pkg_config) + " " +
           std::string(found->folder) + (found->certain ? "" : "?");
}

std::string missing(const std::string& header) {
    return "/x/Old.cpp:3:10: fatal error: " + header + ": No such file or directory";
}

std::string undefined(const std::string& symbol) {
    return "Old.cpp:9: undefined reference to `" + symbol + "'";
}

} // namespace

TEST_CASE("the packages, modules and include folders of libraries that robots use are in Debian's table") {
    CHECK(package_of("SFML/Graphics.hpp") == "libsfml-dev sfml-graphics .");
    CHECK(package_of("SFML/Audio/Music.hpp") == "libsfml-dev sfml-audio .");
    CHECK(package_of("mrpt/poses/CPose3D.h") == "libmrpt-poses-dev  mrpt/poses/include");
    CHECK(package_of("pcl/filters/voxel_grid.h") == "libpcl-dev pcl_filters pcl-1.13");
    CHECK(package_of("pcl/io/pcd_io.h") == "libpcl-dev pcl_io pcl-1.13");
    CHECK(package_of("vtkRenderer.h") == "libvtk9-dev  vtk-9.1");
    CHECK(package_of("kdl/frames.hpp") == "liborocos-kdl-dev orocos-kdl .");
    CHECK(package_of("frames.hpp") == "liborocos-kdl-dev orocos-kdl kdl?");
    CHECK(package_of("GL/glut.h") == "libglut-dev glut .");
    CHECK(package_of("GL/glu.h") == "libglu1-mesa-dev glu .");
    CHECK(package_of("opencv2/core/core.hpp") == "libopencv-dev opencv4 opencv4");
    CHECK(package_of("Eigen/Dense") == "libeigen3-dev eigen3 eigen3");
    CHECK(package_of("eigen3/Eigen/Dense") == "libeigen3-dev eigen3 .");
    CHECK(package_of("boost/thread/mutex.hpp") == "libboost-thread-dev  .");
    CHECK(package_of("boost/shared_ptr.hpp") == "libboost-dev  .");
    CHECK(package_of("SDL/SDL.h") == "libsdl1.2-dev sdl .");
    CHECK(package_of("SDL2/SDL.h") == "libsdl2-dev sdl2 .");
    CHECK(package_of("json/json.h") == "libjsoncpp-dev jsoncpp jsoncpp");
    CHECK(package_of("QWidget") == "qtbase5-dev Qt5Widgets qt5/QtWidgets");
    CHECK(package_of("speex/speex_echo.h") == "libspeexdsp-dev speexdsp .");
    CHECK(find_package_of_library("ode") == "libode-dev");
    CHECK(find_package_of_module("pcl_filters") == "libpcl-dev");
}

TEST_CASE("a header whose name says little belongs to no package") {
    for (const char* name :
         {"config.h", "utils.h", "types.h", "Timer.h", "vector.h", "string", "stdio.h", "", "/"})
        CHECK(package_of(name) == "");
}

TEST_CASE("a remedy that the build already uses is not advised again") {
    const Folder root;
    const fs::path nowhere = root.path() / "Comp";
    const auto remedy = [&](const std::string& error, const std::vector<std::string>& modules = {},
                            const std::vector<std::string>& libraries = {}) {
        return find_remedy(error, {nowhere, modules, libraries, root.path()});
    };
    CHECK(remedy(missing("ode/ode.h")) == "apt install libode-dev");
    CHECK_THAT(
        remedy(missing("pigpiod_if2.h")),
        Catch::StartsWith("pigpiod_if2.h belongs to the C library of pigpio, which Debian does not package"));
    CHECK_THAT(remedy(missing("rtcpcl/pc_traits.h")),
               Catch::StartsWith("rtcpcl/pc_traits.h belongs to RTC:PCL"));
    CHECK_THAT(remedy(missing("Kinect.h")), Catch::StartsWith("Kinect.h is a Windows header"));
    CHECK(remedy(missing("frames.hpp")) == "if kdl/frames.hpp is meant: apt install liborocos-kdl-dev");
    CHECK(remedy(undefined("dWorldCreate")) == "apt install libode-dev");
    CHECK_THAT(remedy(missing("MySVC_impl.h")), Catch::StartsWith("RTCBuilder makes it from My.idl"));
    CHECK(remedy("CMake Error: pkg-config knows no module ode; install") == "apt install libode-dev");
    root.write("var/lib/dpkg/info/libode-dev:amd64.list", "/.\n/usr/include/ode/ode.h\n");
    root.write("var/lib/dpkg/info/libboost-thread-dev.list", "/.\n");
    CHECK(remedy(missing("ode/old.h")) ==
          "libode-dev is installed and has no ode/old.h: the source needs another version of the library");
    CHECK(remedy(undefined("dWorldCreate")) == "--pkg-config ode");
    CHECK_THAT(remedy(undefined("dWorldCreate"), {"ode"}),
               Catch::StartsWith("ode is already used and does not define it") &&
                   Catch::Contains("--source FILE"));
    CHECK(remedy(undefined("boost::thread::join()")) == "-l boost_thread");
    CHECK_THAT(remedy(undefined("boost::thread::join()"), {}, {"boost_thread"}),
               Catch::StartsWith("boost_thread is already used"));
    CHECK_THAT(remedy("/usr/bin/ld: cannot find -lode: No such file or directory"),
               Catch::StartsWith("libode-dev is installed and has no libode.so"));
}

TEST_CASE("an installed library with a function that the linker misses is added once") {
    const Folder root;
    root.write("var/lib/dpkg/info/libode-dev:amd64.list", "/.\n");
    root.write("var/lib/dpkg/info/libboost-thread-dev.list", "/.\n");
    const auto output = undefined("dWorldCreate") + "\n" + undefined("boost::thread::join()") + "\n" +
                        undefined("cv::imshow()") + "\n" + undefined("Arm::move()") + "\n";
    MissingLibraries libraries;
    CHECK(add_libraries(output, libraries, root.path()));
    CHECK(libraries.modules == std::set<std::string>{"ode"});
    CHECK(libraries.names == std::set<std::string>{"boost_thread"});
    CHECK_FALSE(add_libraries(output, libraries, root.path()));
}

TEST_CASE("an installed header is found in a folder that the compiler does not search, with its libraries") {
    const Folder root;
    CHECK(!find_installed_library("vtkRenderer.h", root.path()));
    root.write("usr/include/vtk-9.1/vtkRenderer.h", "");
    root.write("usr/lib/libvtkCommonCore-9.1.so", "");
    root.write("var/lib/dpkg/info/libvtk9-dev.list",
               "/.\n/usr/lib\n/usr/lib/libvtkCommonCore-9.1.so\n/usr/lib/libvtkGone-9.1.so\n");
    const auto vtk = find_installed_library("vtkRenderer.h", root.path());
    REQUIRE(vtk);
    CHECK(vtk->include_dir == root.path() / "usr/include/vtk-9.1");
    CHECK(vtk->libraries == std::vector<fs::path>{root.path() / "usr/lib/libvtkCommonCore-9.1.so"});
    root.write("usr/include/kdl/frames.hpp", "");
    const auto kdl = find_installed_library("frames.hpp", root.path());
    REQUIRE(kdl);
    CHECK(kdl->include_dir == root.path() / "usr/include/kdl");
    CHECK(kdl->pkg_config == "orocos-kdl");
    CHECK(kdl->libraries.empty());
    // Without a package: only a name with a folder, and only if one library has it.
    root.write("usr/local/include/arm-2/arm/Joint.h", "");
    root.write("usr/local/include/arm-2/Motor.h", "");
    const auto arm = find_installed_library("arm/Joint.h", root.path());
    REQUIRE(arm);
    CHECK(arm->include_dir == root.path() / "usr/local/include/arm-2");
    CHECK(!find_installed_library("Motor.h", root.path()));
    root.write("usr/local/include/arm-3/arm/Joint.h", "");
    CHECK(!find_installed_library("arm/Joint.h", root.path()));
}

TEST_CASE("a header whose name several packages have belongs to the library of the other included headers") {
    const Folder root;
    const std::set<std::string> names{"Eigen/LU", "chain.hpp", "chaindynparam.hpp", "string"};
    const auto remedy = [&] {
        return find_remedy(missing("chain.hpp"), {root.path() / "Comp", {}, {}, root.path(), names});
    };
    CHECK(package_of("chain.hpp") == "");
    CHECK(remedy() ==
          "if it belongs to kdl/chaindynparam.hpp, which the component includes, too: apt install "
          "liborocos-kdl-dev");
    CHECK(!find_installed_beside("chain.hpp", names, root.path()));
    root.write("usr/include/kdl/chaindynparam.hpp", "");
    CHECK(!find_installed_beside("chain.hpp", names, root.path()));
    root.write("usr/include/kdl/chain.hpp", "");
    const auto kdl = find_installed_beside("chain.hpp", names, root.path());
    REQUIRE(kdl);
    CHECK(kdl->include_dir == root.path() / "usr/include/kdl");
    CHECK(kdl->pkg_config == "orocos-kdl");
    CHECK(!find_installed_beside("chain.hpp", {"chain.hpp", "string"}, root.path()));
    root.write("var/lib/dpkg/info/liborocos-kdl-dev:amd64.list", "/.\n");
    CHECK_THAT(remedy(), Catch::StartsWith("if you have the library"));
}

TEST_CASE("the names that a component includes and does not contain are known") {
    const Folder folder;
    const auto source =
        folder.write("Comp/Comp.cpp", "#include \"Arm.h\"\n#include <chain.hpp>\n#include \"arm.h\"\n");
    folder.write("Comp/Arm.h", "#include <chaindynparam.hpp>\n");
    CHECK(scan_includes(folder.path() / "Comp", {source}, {}).unknown ==
          std::set<std::string>{"chain.hpp", "chaindynparam.hpp"});
}

TEST_CASE("a header of the component does not add the pkg-config module of a package with one of its name") {
    const Folder folder;
    const auto source = folder.write("Comp/Comp.cpp", "#include \"json/json.h\"\n#include <ode/ode.h>\n");
    const auto modules = [&] { return scan_includes(folder.path() / "Comp", {source}, {}).pkg_config; };
    CHECK(modules() == std::set<std::string>{"jsoncpp", "ode"});
    folder.write("Comp/json/json.h", "");
    CHECK(modules() == std::set<std::string>{"ode"});
}

TEST_CASE("the path of a source in --exclude leaves a file of the same name in another folder") {
    const Folder folder;
    const std::string entry = "Component* getComponent() { return 0; }\n";
    folder.write("Comp/flag.cpp", entry);
    folder.write("Comp/src/flag.cpp", entry);
    const auto selected = [&](const std::string& excluded) {
        CMakeProjects projects("", 60);
        std::vector<std::string> names;
        for (const auto& file :
             select_sources(folder.path() / "Comp", {"getComponent"}, {{}, {excluded}}, {"Comp", projects})
                 .sources)
            names.push_back(file.lexically_relative(fs::canonical(folder.path() / "Comp")));
        return names;
    };
    using Names = std::vector<std::string>;
    CHECK(selected("flag.cpp") == Names{"src/flag.cpp"});
    CHECK(selected("src/flag.cpp") == Names{"flag.cpp"});
    CHECK(selected((folder.path() / "Comp/src/flag.cpp").string()) == Names{"flag.cpp"});
    CHECK(selected("src/*") == Names{"flag.cpp"});
}

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/header_packages.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <iterator>
#include <set>
#include <utility>

namespace tandem::command {
namespace {

// If one name begins with another, the longer name comes first.
const LibraryPackage table[] = {
    {"opencv2/", "libopencv-dev", "opencv4", "opencv_core", "cv"},
    {"Eigen/", "libeigen3-dev", "eigen3", "", ""},
    {"eigen3/", "libeigen3-dev", "eigen3", "", ""},
    {"boost/thread", "libboost-thread-dev", "", "boost_thread", "boost::thread"},
    {"boost/filesystem", "libboost-filesystem-dev", "", "boost_filesystem", "boost::filesystem"},
    {"boost/regex", "libboost-regex-dev", "", "boost_regex", "boost::re_detail"},
    {"boost/date_time", "libboost-date-time-dev", "", "boost_date_time", "boost::gregorian"},
    {"boost/program_options", "libboost-program-options-dev", "", "boost_program_options",
     "boost::program_options"},
    {"boost/serialization", "libboost-serialization-dev", "", "boost_serialization", "boost::archive"},
    {"boost/system", "libboost-system-dev", "", "boost_system", "boost::system"},
    {"boost/", "libboost-dev", "", "", ""},
    {"XnCppWrapper.h", "libopenni-dev", "libopenni", "OpenNI", "xn"},
    {"OpenNI.h", "libopenni2-dev", "libopenni2", "OpenNI2", "openni::"},
    {"libfreenect", "libfreenect-dev", "libfreenect", "freenect", "freenect_"},
    {"dc1394/", "libdc1394-dev", "libdc1394-2", "dc1394", "dc1394_"},
    {"libraw1394/", "libraw1394-dev", "libraw1394", "raw1394", "raw1394_"},
    {"pcl/", "libpcl-dev", "pcl_io", "pcl_common", "pcl::"},
    {"ode/", "libode-dev", "ode", "ode", "dWorld"},
    {"GL/glut.h", "freeglut3-dev", "glut", "glut", "glut"},
    {"GL/freeglut", "freeglut3-dev", "glut", "glut", "glut"},
    {"GL/glew.h", "libglew-dev", "glew", "GLEW", "glew"},
    {"GL/glu.h", "libglu1-mesa-dev", "glu", "GLU", "glu"},
    {"GL/", "libgl-dev", "gl", "GL", "gl"},
    {"GLFW/", "libglfw3-dev", "glfw3", "glfw", "glfw"},
    {"X11/", "libx11-dev", "x11", "X11", "X"},
    {"jpeglib.h", "libjpeg-dev", "libjpeg", "jpeg", "jpeg_"},
    {"png.h", "libpng-dev", "libpng", "png", "png_"},
    {"tiffio.h", "libtiff-dev", "libtiff-4", "tiff", "TIFF"},
    {"zlib.h", "zlib1g-dev", "zlib", "z", "inflate"},
    {"speex/speex_preprocess.h", "libspeexdsp-dev", "speexdsp", "speexdsp", "speex_"},
    {"speex/speex_echo.h", "libspeexdsp-dev", "speexdsp", "speexdsp", "speex_"},
    {"speex/speex_resampler.h", "libspeexdsp-dev", "speexdsp", "speexdsp", "speex_"},
    {"speex/", "libspeex-dev", "speex", "speex", "speex_"},
    {"fftw3.h", "libfftw3-dev", "fftw3", "fftw3", "fftw_"},
    {"samplerate.h", "libsamplerate0-dev", "samplerate", "samplerate", "src_"},
    {"libresample.h", "libresample1-dev", "", "resample", "resample_"},
    {"sndfile.h", "libsndfile1-dev", "sndfile", "sndfile", "sf_"},
    {"portaudio.h", "portaudio19-dev", "portaudio-2.0", "portaudio", "Pa_"},
    {"pulse/", "libpulse-dev", "libpulse-simple", "pulse-simple", "pa_"},
    {"AL/alut.h", "libalut-dev", "freealut", "alut", "alut"},
    {"AL/", "libopenal-dev", "openal", "openal", "al"},
    {"alsa/", "libasound2-dev", "alsa", "asound", "snd_"},
    {"SDL/", "libsdl1.2-dev", "sdl", "SDL", "SDL_"},
    {"SDL2/", "libsdl2-dev", "sdl2", "SDL2", "SDL_"},
    {"gtkmm.h", "libgtkmm-2.4-dev", "gtkmm-2.4", "gtkmm-2.4", "Gtk::"},
    {"gtk/", "libgtk2.0-dev", "gtk+-2.0", "gtk-x11-2.0", "gtk_"},
    {"glib.h", "libglib2.0-dev", "glib-2.0", "glib-2.0", "g_"},
    {"libxml/", "libxml2-dev", "libxml-2.0", "xml2", "xml"},
    {"libxslt/", "libxslt1-dev", "libxslt", "xslt", "xslt"},
    {"tinyxml2.h", "libtinyxml2-dev", "tinyxml2", "tinyxml2", "tinyxml2::"},
    {"tinyxml.h", "libtinyxml-dev", "tinyxml", "tinyxml", "TiXml"},
    {"yaml-cpp/", "libyaml-cpp-dev", "yaml-cpp", "yaml-cpp", "YAML::"},
    {"nlohmann/", "nlohmann-json3-dev", "nlohmann_json", "", ""},
    {"json/", "libjsoncpp-dev", "jsoncpp", "jsoncpp", "Json::"},
    {"curl/", "libcurl4-openssl-dev", "libcurl", "curl", "curl_"},
    {"openssl/", "libssl-dev", "openssl", "ssl", "SSL_"},
    {"usb.h", "libusb-dev", "libusb", "usb", "usb_"},
    {"libusb", "libusb-1.0-0-dev", "libusb-1.0", "usb-1.0", "libusb_"},
    {"ftdi.h", "libftdi1-dev", "libftdi1", "ftdi1", "ftdi_"},
    {"spnav.h", "libspnav-dev", "spnav", "spnav", "spnav_"},
    {"hidapi/", "libhidapi-dev", "hidapi-libusb", "hidapi-libusb", "hid_"},
    {"libserial/", "libserial-dev", "libserial", "serial", "LibSerial::"},
    {"SerialStream.h", "libserial-dev", "libserial", "serial", "LibSerial::"},
    {"mosquitto.h", "libmosquitto-dev", "libmosquitto", "mosquitto", "mosquitto_"},
    {"modbus", "libmodbus-dev", "libmodbus", "modbus", "modbus_"},
    {"bluetooth/", "libbluetooth-dev", "bluez", "bluetooth", "hci_"},
    {"cwiid.h", "libcwiid-dev", "cwiid", "cwiid", "cwiid_"},
    {"zmq.h", "libzmq3-dev", "libzmq", "zmq", "zmq_"},
    {"sqlite3.h", "libsqlite3-dev", "sqlite3", "sqlite3", "sqlite3_"},
    {"mysql/", "libmariadb-dev", "libmariadb", "mariadb", "mysql_"},
    {"libpq-fe.h", "libpq-dev", "libpq", "pq", "PQ"},
    {"pcap.h", "libpcap-dev", "libpcap", "pcap", "pcap_"},
    {"gsl/", "libgsl-dev", "gsl", "gsl", "gsl_"},
    {"nlopt.h", "libnlopt-dev", "nlopt", "nlopt", "nlopt_"},
    {"lapacke.h", "liblapacke-dev", "lapacke", "lapacke", "LAPACKE_"},
    {"assimp/", "libassimp-dev", "assimp", "assimp", "Assimp::"},
    {"btBullet", "libbullet-dev", "bullet", "BulletDynamics", "bt"},
    {"octomap/", "liboctomap-dev", "octomap", "octomap", "octomap::"},
    {"fcl/", "libfcl-dev", "fcl", "fcl", "fcl::"},
    {"orocos/kdl", "liborocos-kdl-dev", "orocos-kdl", "orocos-kdl", "KDL::"},
    {"kdl/", "liborocos-kdl-dev", "orocos-kdl", "orocos-kdl", "KDL::"},
    {"ncurses.h", "libncurses-dev", "ncurses", "ncurses", "wgetch"},
    {"curses.h", "libncurses-dev", "ncurses", "ncurses", "wgetch"},
    {"readline/", "libreadline-dev", "readline", "readline", "readline"},
    {"libv4l", "libv4l-dev", "libv4l2", "v4l2", "v4l2_"},
    {"Python.h", "python3-dev", "python3-embed", "python3.11", "Py"},
    {"lua.h", "liblua5.3-dev", "lua5.3", "lua5.3", "lua_"},
    {"ros/", "libroscpp-dev", "roscpp", "roscpp", "ros::"},
    {"std_msgs/", "libstd-msgs-dev", "std_msgs", "", ""},
    {"sensor_msgs/", "libsensor-msgs-dev", "sensor_msgs", "", ""},
    {"geometry_msgs/", "libgeometry-msgs-dev", "geometry_msgs", "", ""},
    {"nav_msgs/", "libnav-msgs-dev", "nav_msgs", "", ""},
    {"cv_bridge/", "libcv-bridge-dev", "cv_bridge", "cv_bridge", "cv_bridge::"},
    {"image_transport/", "libimage-transport-dev", "image_transport", "image_transport", "image_transport::"},
    {"tf2_ros/", "libtf2-ros-dev", "tf2_ros", "tf2_ros", "tf2_ros::"},
    {"tf/", "libtf-dev", "tf", "tf", "tf::"},
};

} // namespace

const LibraryPackage* find_package_of_header(const std::string& header) {
    if (is_old_opencv_header(header)) return table;
    for (const auto& each : table)
        if (header.rfind(each.header, 0) == 0) return &each;
    return nullptr;
}

const LibraryPackage* find_package_of_library(const std::string& library) {
    if (library.rfind("opencv_", 0) == 0) return table;
    for (const auto& each : table)
        if (library == each.library) return &each;
    return nullptr;
}

const char* origin_outside_debian(const std::string& header) {
    static constexpr std::pair<const char*, const char*> origins[] = {
        {"drawstuff", "a demonstration library in the source archive of ODE"},
        {"hrpModel/", "OpenHRP3"},
        {"hrpUtil/", "OpenHRP3"},
        {"cnoid/", "Choreonoid"},
        {"HD/", "OpenHaptics of 3D Systems"},
        {"flycapture/", "FlyCapture of Point Grey"},
        {"pgrflycapture", "FlyCapture of Point Grey"},
        {"librealsense", "librealsense of Intel"},
        {"mraa", "mraa of Intel"},
        {"wiringPi", "WiringPi"},
    };
    for (const auto& [begin, origin] : origins)
        if (header.rfind(begin, 0) == 0) return origin;
    return nullptr;
}

// A prefix matches only before another case or a digit: "glutInit" is not from GL, and "Xerces" not from X11.
const LibraryPackage* find_package_of_symbol(const std::string& symbol) {
    for (const auto& each : table) {
        const std::string prefix = each.symbol;
        if (prefix.empty() || symbol.rfind(prefix, 0) != 0 || symbol.size() == prefix.size()) continue;
        const char last = prefix.back(), next = symbol[prefix.size()];
        const bool word_goes_on = last >= 'a' && last <= 'z' && next >= 'a' && next <= 'z';
        if (!word_goes_on) return &each;
    }
    return nullptr;
}

bool is_windows_header(const std::string& header) {
    static const std::set<std::string> names{
        "windows.h",  "winsock.h", "winsock2.h", "ws2tcpip.h", "windef.h",   "winbase.h", "mmsystem.h",
        "conio.h",    "tchar.h",   "afx.h",      "afxwin.h",   "afxext.h",   "afxcmn.h",  "afxdisp.h",
        "afxole.h",   "atlbase.h", "atlstr.h",   "comdef.h",   "objbase.h",  "process.h", "direct.h",
        "io.h",       "dinput.h",  "d3d9.h",     "dshow.h",    "vfw.h",      "xinput.h",  "setupapi.h",
        "hidsdi.h",   "crtdbg.h",  "sapi.h",     "initguid.h", "shellapi.h", "shlobj.h",  "commctrl.h",
        "richedit.h", "mmreg.h",   "dsound.h",   "targetver.h"};
    return names.count(to_lower(header)) != 0;
}

bool is_old_opencv_header(const std::string& header) {
    static const std::set<std::string> names{"cv.h",      "cv.hpp",    "cxcore.h",  "cxcore.hpp",
                                             "cvaux.h",   "cvaux.hpp", "highgui.h", "highgui.hpp",
                                             "cxtypes.h", "cvtypes.h", "cxmisc.h"};
    return names.count(header) != 0 ||
           (header.rfind("opencv/", 0) == 0 && names.count(header.substr(7)) != 0);
}

} // namespace tandem::command

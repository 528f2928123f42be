// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/packages/symbol_libraries.hpp"

namespace tandem::command {
namespace {

// Debian has no index of symbols, so this table is written by hand. If one prefix begins with another, the longer one
// comes first.
const SymbolLibrary table[] = {
    {"cv", "opencv4", "opencv_core"},
    {"boost::thread", "", "boost_thread"},
    {"boost::filesystem", "", "boost_filesystem"},
    {"boost::re_detail", "", "boost_regex"},
    {"boost::gregorian", "", "boost_date_time"},
    {"boost::program_options", "", "boost_program_options"},
    {"boost::archive", "", "boost_serialization"},
    {"boost::system", "", "boost_system"},
    {"xn", "libopenni", "OpenNI"},
    {"openni::", "libopenni2", "OpenNI2"},
    {"freenect_", "libfreenect", "freenect"},
    {"dc1394_", "libdc1394-2", "dc1394"},
    {"raw1394_", "libraw1394", "raw1394"},
    {"pcl::", "pcl_io", "pcl_common"},
    {"dWorld", "ode", "ode"},
    {"glut", "glut", "glut"},
    {"glew", "glew", "GLEW"},
    {"glu", "glu", "GLU"},
    {"gl", "gl", "GL"},
    {"glfw", "glfw3", "glfw"},
    {"X", "x11", "X11"},
    {"jpeg_", "libjpeg", "jpeg"},
    {"png_", "libpng", "png"},
    {"TIFF", "libtiff-4", "tiff"},
    {"inflate", "zlib", "z"},
    {"speex_", "speexdsp", "speexdsp"},
    {"fftw_", "fftw3", "fftw3"},
    {"src_", "samplerate", "samplerate"},
    {"resample_", "", "resample"},
    {"sf_", "sndfile", "sndfile"},
    {"Pa_", "portaudio-2.0", "portaudio"},
    {"pa_", "libpulse-simple", "pulse-simple"},
    {"alut", "freealut", "alut"},
    {"al", "openal", "openal"},
    {"snd_", "alsa", "asound"},
    {"SDL_", "sdl", "SDL"},
    {"Gtk::", "gtkmm-2.4", "gtkmm-2.4"},
    {"gtk_", "gtk+-2.0", "gtk-x11-2.0"},
    {"g_", "glib-2.0", "glib-2.0"},
    {"xml", "libxml-2.0", "xml2"},
    {"xslt", "libxslt", "xslt"},
    {"tinyxml2::", "tinyxml2", "tinyxml2"},
    {"TiXml", "tinyxml", "tinyxml"},
    {"YAML::", "yaml-cpp", "yaml-cpp"},
    {"Json::", "jsoncpp", "jsoncpp"},
    {"curl_", "libcurl", "curl"},
    {"SSL_", "openssl", "ssl"},
    {"usb_", "libusb", "usb"},
    {"libusb_", "libusb-1.0", "usb-1.0"},
    {"ftdi_", "libftdi1", "ftdi1"},
    {"spnav_", "spnav", "spnav"},
    {"hid_", "hidapi-libusb", "hidapi-libusb"},
    {"LibSerial::", "libserial", "serial"},
    {"mosquitto_", "libmosquitto", "mosquitto"},
    {"modbus_", "libmodbus", "modbus"},
    {"hci_", "bluez", "bluetooth"},
    {"cwiid_", "cwiid", "cwiid"},
    {"zmq_", "libzmq", "zmq"},
    {"sqlite3_", "sqlite3", "sqlite3"},
    {"mysql_", "libmariadb", "mariadb"},
    {"PQ", "libpq", "pq"},
    {"pcap_", "libpcap", "pcap"},
    {"gsl_", "gsl", "gsl"},
    {"nlopt_", "nlopt", "nlopt"},
    {"LAPACKE_", "lapacke", "lapacke"},
    {"Assimp::", "assimp", "assimp"},
    {"bt", "bullet", "BulletDynamics"},
    {"octomap::", "octomap", "octomap"},
    {"fcl::", "fcl", "fcl"},
    {"KDL::", "orocos-kdl", "orocos-kdl"},
    {"wgetch", "ncurses", "ncurses"},
    {"readline", "readline", "readline"},
    {"v4l2_", "libv4l2", "v4l2"},
    {"Py", "python3-embed", "python3.11"},
    {"lua_", "lua5.3", "lua5.3"},
    {"ros::", "roscpp", "roscpp"},
    {"cv_bridge::", "cv_bridge", "cv_bridge"},
    {"image_transport::", "image_transport", "image_transport"},
    {"tf2_ros::", "tf2_ros", "tf2_ros"},
    {"tf::", "tf", "tf"},
};

} // namespace

// A prefix matches only before another case or a digit: "glutInit" is not from GL, and "Xerces" not from X11.
const SymbolLibrary* find_library_of_symbol(const std::string& symbol) {
    for (const auto& each : table) {
        const std::string prefix = each.symbol;
        if (symbol.rfind(prefix, 0) != 0 || symbol.size() == prefix.size()) continue;
        const char last = prefix.back(), next = symbol[prefix.size()];
        const bool word_goes_on = last >= 'a' && last <= 'z' && next >= 'a' && next <= 'z';
        if (!word_goes_on) return &each;
    }
    return nullptr;
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/packages/header_packages.hpp"
#include "apps/tandem/build/folder/source_text.hpp"

#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace tandem::command {
namespace {

// Lines of header_packages.txt. As std::string_view, they would take more steps than clang allows in a constant expression.
constexpr const char* lines[] = {
#include "header_packages.inc"
};

std::string_view next_word(std::string_view& line) {
    const auto word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    return word;
}

struct Table {
    std::unordered_map<std::string_view, HeaderPackage>
        headers; ///< also by folder ("pcl/") and prefix ("vtk*")
    std::unordered_map<std::string_view, std::string_view> libraries, modules;
};

Table read_table() {
    Table table;
    for (std::string_view line : lines) {
        if (line.starts_with('#')) continue;
        const auto package = next_word(line), module = next_word(line), folder = next_word(line);
        const bool certain = !folder.starts_with('~');
        const HeaderPackage entry{package, module == "-" ? "" : module, folder.substr(certain ? 0 : 1),
                                  certain};
        if (module != "-") table.modules.try_emplace(module, package);
        while (!line.empty()) {
            if (folder == "-l")
                table.libraries.emplace(next_word(line), package);
            else
                table.headers.emplace(next_word(line), entry);
        }
    }
    return table;
}

const Table& table() {
    static const Table made = read_table();
    return made;
}

std::string_view find_package(const std::unordered_map<std::string_view, std::string_view>& packages,
                              const std::string& name) {
    const auto found = packages.find(name);
    return found == packages.end() ? "" : found->second;
}

} // namespace

// The longest match counts: the table has a folder's exceptions beside the folder.
std::optional<HeaderPackage> find_package_of_header(const std::string& header) {
    const auto& headers = table().headers;
    if (is_old_opencv_header(header)) return headers.at("opencv2/");
    if (const auto found = headers.find(header); found != headers.end()) return found->second;
    for (auto size = header.size(); size > 2; --size) {
        const auto begin = header.substr(0, size);
        auto found = headers.find(begin.back() == '/' ? begin : begin + "*");
        if (found != headers.end()) return found->second;
    }
    return std::nullopt;
}

std::string_view find_package_of_library(const std::string& library) {
    return find_package(table().libraries, library);
}

std::string_view find_package_of_module(const std::string& module) {
    return find_package(table().modules, module);
}

const char* origin_outside_debian(const std::string& header) {
    static constexpr std::pair<const char*, const char*> origins[] = {
        {"drawstuff", "a demonstration library in the source archive of ODE"},
        {"hrpModel/", "OpenHRP3"},
        {"hrpUtil/", "OpenHRP3"},
        {"cnoid/", "Choreonoid"},
        {"HD/", "OpenHaptics of 3D Systems"},
        {"flycapture/", "FlyCapture of Point Grey"},
        {"FlyCapture", "FlyCapture of Point Grey"},
        {"pgrflycapture", "FlyCapture of Point Grey"},
        {"librealsense", "librealsense of Intel"},
        {"mraa", "mraa of Intel"},
        {"wiringPi", "WiringPi"},
        {"pigpio", "the C library of pigpio"}, // libpigpiod-if-dev includes pigpio.h, which no package has
        {"mc_control/", "mc_rtc"},
        {"mc_rtc/", "mc_rtc"},
        {"rtcpcl/", "RTC:PCL of gbiggs"},
        {"rtmdds/", "RTM:DDS of gbiggs"},
        {"ypspur", "YP-Spur"},
        {"stage.hh", "Stage of the Player project"},
        {"openvr", "OpenVR of Valve"},
        {"k4a/", "the Azure Kinect SDK of Microsoft"},
        {"mclmcr", "the MATLAB Runtime"},
        {"mclcppclass", "the MATLAB Runtime"},
    };
    for (const auto& [begin, origin] : origins)
        if (header.rfind(begin, 0) == 0) return origin;
    return nullptr;
}

bool is_windows_header(const std::string& header) {
    static const std::set<std::string> names{
        "windows.h",  "winsock.h", "winsock2.h", "ws2tcpip.h",  "windef.h",   "winbase.h", "mmsystem.h",
        "conio.h",    "tchar.h",   "afx.h",      "afxwin.h",    "afxext.h",   "afxcmn.h",  "afxdisp.h",
        "afxole.h",   "atlbase.h", "atlstr.h",   "comdef.h",    "objbase.h",  "process.h", "direct.h",
        "io.h",       "dinput.h",  "d3d9.h",     "dshow.h",     "vfw.h",      "xinput.h",  "setupapi.h",
        "hidsdi.h",   "crtdbg.h",  "sapi.h",     "initguid.h",  "shellapi.h", "shlobj.h",  "commctrl.h",
        "richedit.h", "mmreg.h",   "dsound.h",   "targetver.h", "kinect.h",   "nuiapi.h"};
    return names.count(to_lower(header)) != 0 || header.starts_with("progid:"); // of #import
}

bool is_old_opencv_header(const std::string& header) {
    static const std::set<std::string> names{"cv.h",      "cv.hpp",    "cxcore.h",  "cxcore.hpp",
                                             "cvaux.h",   "cvaux.hpp", "highgui.h", "highgui.hpp",
                                             "cxtypes.h", "cvtypes.h", "cxmisc.h"};
    return names.count(header) != 0 ||
           (header.rfind("opencv/", 0) == 0 && names.count(header.substr(7)) != 0);
}

} // namespace tandem::command

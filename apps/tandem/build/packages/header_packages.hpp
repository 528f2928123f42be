// SPDX-License-Identifier: Apache-2.0
// Finds the Debian package of a header or library that components use, in the table of README.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tandem::command {

/// The package of a header in Debian 12.
struct HeaderPackage {
    std::string_view package;    ///< the package to install with apt
    std::string_view pkg_config; ///< the pkg-config module for include folders and libraries; "" if unknown
    std::string_view folder;     ///< the include folder below /usr/include that the name is relative to
    bool certain;                ///< false: the package is meant if the name lacks its folder
};

/// Returns the package of a header in an #include.
std::optional<HeaderPackage> find_package_of_header(const std::string& header);

/// Return the package of a library after -l, or of a pkg-config module; "" if it is unknown.
std::string_view find_package_of_library(const std::string& library);
std::string_view find_package_of_module(const std::string& module);

/// Returns the origin of a header that Debian 12 does not package; nullptr if it is unknown.
const char* origin_outside_debian(const std::string& header);

/// Returns whether the header exists only on Windows or in Visual C++.
bool is_windows_header(const std::string& header);

/// Returns whether it is a C header of OpenCV 1 or 2, for example cv.h or highgui.h, including below opencv/.
bool is_old_opencv_header(const std::string& header);

} // namespace tandem::command

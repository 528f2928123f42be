// SPDX-License-Identifier: Apache-2.0
// Finds the Debian package of a header or library that components use.
#pragma once

#include <string>

namespace tandem::command {

/// A library of Debian 12. Unknown fields are empty strings.
struct LibraryPackage {
    const char* header;     ///< name of a header, or of a folder with '/' at its end
    const char* package;    ///< the package to install with apt
    const char* pkg_config; ///< the pkg-config module for include folders and libraries
    const char* library;    ///< the name after -l
    const char* symbol;     ///< prefix of its function names
};

/// Return the package of a header in an #include, of a library after -l, or of an undefined symbol; nullptr
/// if it is not in the table.
const LibraryPackage* find_package_of_header(const std::string& header);
const LibraryPackage* find_package_of_library(const std::string& library);
const LibraryPackage* find_package_of_symbol(const std::string& symbol);

/// Returns the origin of a header that Debian 12 does not package; nullptr if it is unknown.
const char* origin_outside_debian(const std::string& header);

/// Returns whether the header exists only on Windows or in Visual C++.
bool is_windows_header(const std::string& header);

/// Returns whether it is a C header of OpenCV 1 or 2, for example cv.h or highgui.h, also below opencv/.
bool is_old_opencv_header(const std::string& header);

} // namespace tandem::command

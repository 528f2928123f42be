// SPDX-License-Identifier: Apache-2.0
// Which Debian package has a header or a library that components use.
#pragma once

#include <string>

namespace tandem::command {

/// A library of Debian 12. Empty strings: there is none.
struct LibraryPackage {
    const char* header;     ///< a header's name, or a folder's with '/' at its end
    const char* package;    ///< what apt installs
    const char* pkg_config; ///< its module of pkg-config, which gives folders and libraries
    const char* library;    ///< the name after -l
    const char* symbol;     ///< how the names of its functions begin
};

/// The package of a header as a source includes it, of a library as -l names it, and of an undefined symbol; nullptr
/// if the table has none.
const LibraryPackage* find_package_of_header(const std::string& header);
const LibraryPackage* find_package_of_library(const std::string& library);
const LibraryPackage* find_package_of_symbol(const std::string& symbol);

/// What a header belongs to, of which Debian 12 has no package; nullptr if that is not known.
const char* origin_outside_debian(const std::string& header);

/// Whether the header comes with Windows or Visual C++ and exists nowhere else.
bool is_windows_header(const std::string& header);

/// Whether it is one of OpenCV 1 and 2 for C: cv.h, cxcore.h, cvaux.h, highgui.h and those below opencv/.
bool is_old_opencv_header(const std::string& header);

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
// Finds the headers that the sources of a component include.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

struct IncludeScan {
    /// Maps names that no include folder contains to the file to include: a file of the component with
    /// another case or in a folder that is not searched, or a header made from an IDL file.
    std::map<std::string, std::string> forwards;
    std::vector<std::filesystem::path>
        idl_files;                 ///< for the headers above, neither in the component's folder nor its idl/
    std::set<std::string> unknown; ///< names that no folder of the component contains
    std::set<std::string> pkg_config; ///< pkg-config modules of the libraries whose headers are included
    bool old_opencv = false;          ///< whether a C header of OpenCV 1 or 2 is included
};

/// Maps names in #include lines to headers of neighbouring components, or to the IDL files that they are made from.
using NeighbourHeaders = std::map<std::string, std::filesystem::path>;

/// Reads the sources, and the headers of the component and of `neighbours` that they include. `include_dirs`:
/// additional include folders.
IncludeScan scan_includes(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& sources,
                          const std::vector<std::filesystem::path>& include_dirs,
                          const NeighbourHeaders& neighbours = {});

/// Writes a header below `folder` for each forward. Returns the folder for the compiler's search path. It is
/// some levels deeper, because names may begin with "../".
std::filesystem::path write_forwards(const std::map<std::string, std::string>& forwards,
                                     const std::filesystem::path& folder);

} // namespace tandem::command

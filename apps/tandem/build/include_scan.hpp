// SPDX-License-Identifier: Apache-2.0
// What the sources of a component include, and where that is found.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

struct IncludeScan {
    /// Names that no folder of headers has, with the file that is meant: one in the component's folder, in another
    /// case or in a folder that is not searched, or the header that an IDL file becomes.
    std::map<std::string, std::string> forwards;
    std::vector<std::filesystem::path>
        idl_files;                    ///< beside the component's folder: those of the headers meant
    std::set<std::string> pkg_config; ///< modules of the libraries whose headers are included
    bool old_opencv = false;          ///< whether a header of OpenCV 1 or 2 for C is included
};

/// Headers of the component's neighbours, by the names under which they are included.
using NeighbourHeaders = std::map<std::string, std::filesystem::path>;

/// Reads the sources and those headers of the component and of `neighbours` that they include. `include_dirs`: folders
/// that are searched besides the component's own and the system's.
IncludeScan scan_includes(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& sources,
                          const std::vector<std::filesystem::path>& include_dirs,
                          const NeighbourHeaders& neighbours = {});

/// Writes a header for each forward that includes what is meant, below `folder`. Returns the folder for the compiler's
/// search path, which lies deeper, because names may begin with "../".
std::filesystem::path write_forwards(const std::map<std::string, std::string>& forwards,
                                     const std::filesystem::path& folder);

} // namespace tandem::command

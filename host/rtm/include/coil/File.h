// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_FILE_H
#define COIL_FILE_H
#include <coil/stringutil.h>
#include <string>
// Component sources use these without including them, because OpenRTM-aist's header includes them.
#include <cstring>
#include <dirent.h>
#include <sys/stat.h>
#include <sys/types.h>

namespace coil {

/// Returns `/a/b` for `/a/b/c`, and `.` for a path without a folder.
std::string dirname(const char* path);
std::string basename(const char* path);
/// Returns the names in a folder that match the glob pattern, or all names without one. Empty if the folder cannot be
/// read.
vstring filelist(const char* path, const char* glob_str = "");
/// Adds the paths of all files with this name (or this extension, without the dot) in the folder and below.
void findFile(const std::string& dir, const std::string& filename, vstring& filelist);
void getFileList(const std::string& dir, const std::string& ext, vstring& filelist);

} // namespace coil
#endif

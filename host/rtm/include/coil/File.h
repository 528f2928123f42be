// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_FILE_H
#define COIL_FILE_H
#include <coil/stringutil.h>
#include <string>
// Component sources count on these being there.
#include <cstring>
#include <dirent.h>
#include <sys/stat.h>
#include <sys/types.h>

namespace coil {

/// `/a/b` of `/a/b/c`; `.` when there is no folder in it.
std::string dirname(const char* path);
std::string basename(const char* path);
/// Names in a folder, those that match a glob pattern when one is given. Empty when it cannot be read.
vstring filelist(const char* path, const char* glob_str = "");
/// Adds the paths of all files of that name (of that extension, without the dot) in the folder and below.
void findFile(const std::string& dir, const std::string& filename, vstring& filelist);
void getFileList(const std::string& dir, const std::string& ext, vstring& filelist);

} // namespace coil
#endif

// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_FILE_H
#define COIL_FILE_H
#include <coil/stringutil.h>
#include <string>
// Component sources use them without including them, as OpenRTM-aist's header has them.
#include <cstring>
#include <dirent.h>
#include <sys/stat.h>
#include <sys/types.h>

namespace coil {

/// `/a/b` for `/a/b/c`; `.` when the path has no folder.
std::string dirname(const char* path);
std::string basename(const char* path);
/// Names in a folder, those that match a glob pattern when one is given. Empty when it cannot be read.
vstring filelist(const char* path, const char* glob_str = "");
/// Adds the paths of all files of that name (of that extension, without the dot) in the folder and below.
void findFile(const std::string& dir, const std::string& filename, vstring& filelist);
void getFileList(const std::string& dir, const std::string& ext, vstring& filelist);

} // namespace coil
#endif

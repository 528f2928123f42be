// SPDX-License-Identifier: Apache-2.0
// Names and lists of files, by std::filesystem; errors give empty results, as OpenRTM-aist's callers expect.
#include <coil/File.h>
#include <filesystem>
#include <fnmatch.h>

namespace coil {
namespace {

namespace fs = std::filesystem;

// Adds the files below `dir` for which `wanted(path)` is true. Folders that cannot be read are skipped.
template <class Wanted>
void collect(const std::string& dir, Wanted wanted, vstring& found) {
    std::error_code error;
    fs::recursive_directory_iterator at(dir, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && at != end; at.increment(error)) {
        std::error_code unknown; // an entry that has just been removed counts as a file
        if (!at->is_directory(unknown) && wanted(at->path())) found.push_back(at->path().string());
    }
}

} // namespace

// Returns the folder without a trailing slash; for a bare name, the current folder.
std::string dirname(const char* path) {
    const fs::path parent = fs::path(path).parent_path();
    return parent.empty() ? "." : parent.string();
}

std::string basename(const char* path) { return fs::path(path).filename().string(); }

// Returns the names in one folder, including folders, in no particular order.
vstring filelist(const char* path, const char* glob_str) {
    vstring names;
    if (path == nullptr) return names;
    std::error_code error;
    for (fs::directory_iterator at(path, error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        // The pattern of the shell, without its special treatment of `/` and leading dots.
        if (*glob_str == '\0' || ::fnmatch(glob_str, name.c_str(), 0) == 0) names.push_back(name);
    }
    return names;
}

void findFile(const std::string& dir, const std::string& filename, vstring& filelist) {
    collect(
        dir, [&](const fs::path& path) { return path.filename() == filename; }, filelist);
}

void getFileList(const std::string& dir, const std::string& ext, vstring& filelist) {
    collect(
        dir, [&](const fs::path& path) { return path.extension() == "." + ext; }, filelist);
}

} // namespace coil

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/system/staged_folder.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// Returns an absolute path without a slash at its end.
fs::path normal(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

/// Returns the place of the new folder: beside a DIR that does not exist, which is then renamed as a whole, else in it.
fs::path staging_place(const fs::path& folder) {
    return fs::exists(folder) ? folder / ".tandem-new"
                              : folder.parent_path() / ("." + folder.filename().string() + ".tandem-new");
}

bool have_same_content(const fs::path& a, const fs::path& b) {
    const auto text = [](const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    return fs::file_size(a) == fs::file_size(b) && text(a) == text(b);
}

bool is_used(const fs::path& folder) { return fs::exists(folder) && !fs::is_empty(folder); }

} // namespace

StagedFolder::StagedFolder(const fs::path& folder) : folder_(normal(folder)), path_(staging_place(folder_)) {
    std::error_code error;
    const bool is_made = fs::create_directories(path_, error);
    if (error)
        throw std::runtime_error("folder " + path_.string() + " cannot be created: " + error.message());
    lock_ = process::FileDescriptor(open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    struct stat status {};
    if (!lock_ || fstat(lock_.get(), &status) != 0 || (!is_made && status.st_uid != geteuid()))
        throw std::runtime_error(path_.string() + " is not a folder of this user; remove it");
    if (flock(lock_.get(), LOCK_EX | LOCK_NB) != 0)
        throw std::runtime_error(
            errno == EWOULDBLOCK ? folder.string() + " is being written by another command; try again later"
                                 : path_.string() + " cannot be locked: " + std::strerror(errno));
    for (const auto& left : fs::directory_iterator(path_)) fs::remove_all(left.path());
}

StagedFolder::~StagedFolder() {
    std::error_code ignored; // a failed removal must not hide the original error
    fs::remove_all(path_, ignored);
}

fs::path StagedFolder::add_side(const char* side) {
    if (is_used(folder_ / side))
        throw std::runtime_error((folder_ / side).string() +
                                 " exists and is not empty; remove it, or name another folder");
    fs::create_directories(path_ / side);
    return path_ / side;
}

void StagedFolder::publish() {
    if (path_.parent_path() != folder_) {
        fs::rename(path_, folder_);
        path_.clear();
        return;
    }
    for (const char* side : {"opros", "rtm"})
        if (fs::exists(path_ / side)) fs::rename(path_ / side, folder_ / side);
}

void StagedFolder::publish_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path_))
        if (entry.is_regular_file()) files.push_back(entry.path());
    for (const fs::path& file : files) {
        const fs::path target = folder_ / file.lexically_relative(path_);
        if (fs::exists(target)) {
            if (have_same_content(file, target)) continue;
            const fs::path copy = file.string() + "~", former = target.string() + "~";
            fs::copy_file(target, copy);
            fs::rename(copy, former);
            fs::permissions(file, fs::status(target).permissions());
        }
        fs::rename(file, target);
    }
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/new_file.hpp"

#include "host/process/output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace tandem::mcap {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// Makes the names of a folder survive a power failure, where the file system supports it.
void sync_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    ::close(descriptor);
}

/// Renames a file to a name that does not exist. Returns 0 or an errno value, EEXIST if the name exists.
int rename_without_replacing(const char* from, const char* to) {
    if (renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    // NFS and folders shared with a virtual machine do not have RENAME_NOREPLACE, and the latter no hard links.
    if (link(from, to) == 0) return unlink(from) == 0 ? 0 : errno;
    if (errno == EEXIST) return errno;
    const int placeholder = open(to, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (placeholder < 0) return errno;
    flock(placeholder, LOCK_EX | LOCK_NB); // keeps a second recorder out until the name belongs to the file
    const int error = rename(from, to) == 0 ? 0 : errno;
    if (error != 0) unlink(to);
    ::close(placeholder);
    return error;
}

} // namespace

NewFile::NewFile(fs::path path, Named named) : path_(std::move(path)) {
    struct stat status {};
    try {
        if (stat(path_.c_str(), &status) == 0)
            open_existing();
        else
            create();
        if (named == Named::at_once) give_name();
    } catch (const Error&) {
        discard();
        throw;
    }
}

NewFile::~NewFile() {
    if (!temporary_.empty()) discard();
    if (descriptor_ >= 0) ::close(descriptor_);
}

void NewFile::create() {
    struct stat status {};
    if (lstat(path_.c_str(), &status) == 0) refuse(); // a symbolic link to nothing
    constexpr int attempts = 100;                     // a killed program with this pid may have left some
    for (int i = 0; i < attempts && descriptor_ < 0; ++i) {
        temporary_ =
            folder_of(path_) / ("tandem-" + std::to_string(getpid()) + "-" + std::to_string(i) + ".part");
        descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
        if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0) {
        const int cause = errno;
        temporary_.clear();
        throw error(cause);
    }
    created_ = true;
    lock(); // fails only if the file system has no locks
}

void NewFile::open_existing() {
    struct stat status {};
    if (stat(path_.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) refuse();
    descriptor_ = process::open_output(path_, process::Existing::keep).release();
    if (fstat(descriptor_, &status) != 0) throw error(errno);
    regular_ = S_ISREG(status.st_mode);
    if (!regular_) return;
    // The size counts only with the lock: another recorder may have begun.
    const bool locked = lock();
    struct stat named {};
    if (locked && fstat(descriptor_, &status) == 0 && status.st_size == 0 &&
        stat(path_.c_str(), &named) == 0 && named.st_ino == status.st_ino && named.st_dev == status.st_dev)
        return;
    ::close(std::exchange(descriptor_, -1));
    refuse();
}

bool NewFile::lock() const { return flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

void NewFile::give_name() {
    if (temporary_.empty()) return;
    const int cause = rename_without_replacing(temporary_.c_str(), path_.c_str());
    if (cause == EEXIST) refuse();
    if (cause != 0) throw error(cause);
    temporary_.clear();
    sync_folder(folder_of(path_));
}

void NewFile::close() {
    give_name();
    const int descriptor = std::exchange(descriptor_, -1);
    if (descriptor >= 0 && ::close(descriptor) != 0) throw error(errno);
}

void NewFile::discard() {
    const int descriptor = std::exchange(descriptor_, -1);
    if (descriptor < 0 || !regular_) {
        if (descriptor >= 0) ::close(descriptor);
        return;
    }
    const fs::path name = temporary_.empty() ? path_ : std::exchange(temporary_, {});
    struct stat own {
    }, named{};
    // The user may have put another file there.
    const bool is_own = fstat(descriptor, &own) == 0 && lstat(name.c_str(), &named) == 0 &&
                        own.st_dev == named.st_dev && own.st_ino == named.st_ino;
    std::error_code ignored; // this is already the end of a failure
    if (is_own && created_) fs::remove(name, ignored);
    if (is_own && !created_) fs::resize_file(name, 0, ignored);
    ::close(descriptor);
}

Error NewFile::error(int cause) const {
    return Error(path_.string() + " cannot be written: " + std::strerror(cause));
}

void NewFile::refuse() const {
    const int descriptor = open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    const bool busy = descriptor >= 0 && flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (descriptor >= 0) ::close(descriptor);
    struct stat status {};
    const bool filled = stat(path_.c_str(), &status) == 0 && status.st_size > 0;
    throw Error(path_.string() + (busy ? " is being written by another program: give another file"
                                  : filled
                                      ? " already exists and is not empty: give another file, or remove it"
                                      : " already exists: give another file, or remove it"));
}

} // namespace tandem::mcap

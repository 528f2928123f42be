// SPDX-License-Identifier: Apache-2.0
#include "host/process/output_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace tandem::process {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
    throw std::runtime_error(file.string() + " cannot be written: " + reason);
}

[[noreturn]] void fail(const std::filesystem::path& file) {
    fail(file, std::generic_category().message(errno));
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
    fail(file,
         "it belongs to another user, in a folder that all users may write to; choose another name, or a "
         "folder of yours");
}

/// A file in a folder that all users may write to. The folder's descriptor stays valid if the folder is renamed.
class SharedFile {
  public:
    SharedFile(const std::filesystem::path& file, int folder)
        : file_(file), folder_(folder), name_(file.filename().string()) {}

    /// A file that this call creates is not checked: on some file systems (FAT, folders shared with a virtual machine) new
    /// files belong to another user.
    FileDescriptor open(int flags, mode_t mode) const {
        FileDescriptor created(openat(folder_, name_.c_str(), flags | O_EXCL | O_NOFOLLOW, mode));
        if (!created && errno != EEXIST) fail(file_);
        return created ? std::move(created) : open_existing(flags, mode);
    }

  private:
    FileDescriptor open_existing(int flags, mode_t mode) const {
        struct stat found {};
        if (fstatat(folder_, name_.c_str(), &found, AT_SYMLINK_NOFOLLOW) != 0) fail(file_);
        require_own(found);
        const int follow = S_ISLNK(found.st_mode) ? 0 : O_NOFOLLOW; // a link of this user is followed
        FileDescriptor descriptor(openat(folder_, name_.c_str(), flags | follow, mode));
        if (!descriptor) fail(file_);
        // The entry may have been replaced since, and a link of this user may lead to a file of another one.
        if (fstat(descriptor.get(), &found) != 0) fail(file_);
        if (!S_ISCHR(found.st_mode)) require_own(found);
        return descriptor;
    }
    void require_own(const struct stat& found) const {
        if (found.st_uid != geteuid()) refuse(file_);
    }

    const std::filesystem::path& file_;
    const int folder_;
    const std::string name_;
};

FileDescriptor open_any(const std::filesystem::path& file, int flags, mode_t mode) {
    const auto parent = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    const FileDescriptor folder(open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    struct stat found {};
    if (!folder || fstat(folder.get(), &found) != 0) fail(file);
    if ((found.st_mode & S_IWOTH) != 0) return SharedFile(file, folder.get()).open(flags, mode);
    FileDescriptor descriptor(open(file.c_str(), flags, mode));
    if (!descriptor) fail(file);
    return descriptor;
}

} // namespace

// Truncates only after the checks. ftruncate() fails for pipes and devices, which have no content to replace.
FileDescriptor open_output(const std::filesystem::path& file, Existing existing, mode_t mode) {
    const int append = existing == Existing::append ? O_APPEND : 0;
    FileDescriptor descriptor = open_any(file, O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY | append, mode);
    struct stat found {};
    const bool is_regular = fstat(descriptor.get(), &found) == 0 && S_ISREG(found.st_mode);
    if (existing == Existing::replace && is_regular && ftruncate(descriptor.get(), 0) != 0) fail(file);
    return descriptor;
}

void write_output(const std::filesystem::path& file, std::string_view text) {
    const FileDescriptor descriptor = open_output(file);
    while (!text.empty()) {
        const ssize_t count = write(descriptor.get(), text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(file);
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

} // namespace tandem::process

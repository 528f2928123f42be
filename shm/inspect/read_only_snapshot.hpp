// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"
#include "shm/os/snapshot.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <span>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::shm {

/// Reads a file without side effects: closing it wakes no watcher of writers, and its access time does not change. Copies
/// the file piece by piece and never maps it: truncating a mapped file causes a SIGBUS, truncating a copied one only a
/// short read.
class ReadOnlySnapshot {
  public:
    explicit ReadOnlySnapshot(const std::string& path) : file_(open(path, O_NOATIME)) {
        if (!file_ && errno == EPERM) file_ = open(path, 0); // only the owner may use O_NOATIME
    }
    /// Returns whether the file was opened; if not, errno has the reason.
    explicit operator bool() const { return static_cast<bool>(file_); }
    int fd() const { return file_.get(); }

    /// Copies to.size() bytes from `offset`. Returns false if the file ends earlier. The loads of one copy precede those of
    /// the next.
    bool read(std::uint64_t offset, std::span<std::byte> to) const {
        if (offset > static_cast<std::uint64_t>(INT64_MAX) - to.size()) return false;
        const auto got =
            pread(file_.get(), static_cast<void*>(to.data()), to.size(), static_cast<off_t>(offset));
        std::atomic_thread_fence(std::memory_order_acquire); // a system call is not a barrier
        return got == static_cast<ssize_t>(to.size());
    }

    /// Copies a struct. A word that a process is just writing may be torn. Then one figure of this observation is wrong, and
    /// nothing else.
    template <class T, std::size_t Bytes>
    bool read(std::uint64_t offset, Snapshot<T, Bytes>& to) const {
        return read(offset, to.room());
    }
    /// Copies a word; empty if it is not within the file.
    std::optional<std::uint64_t> read_word(std::uint64_t offset) const {
        std::uint64_t word = 0;
        if (!read(offset, std::as_writable_bytes(std::span(&word, 1)))) return std::nullopt;
        return word;
    }
    /// Returns the memory that the file takes; a sparse file takes less than its size. Nothing that a process has stored in
    /// the file is longer. Makes one system call.
    std::uint64_t memory_bytes() const {
        struct stat status {};
        constexpr std::uint64_t block = 512; // unit of st_blocks
        return fstat(file_.get(), &status) == 0 ? static_cast<std::uint64_t>(status.st_blocks) * block : 0;
    }

  private:
    /// O_NONBLOCK: if a FIFO has replaced the file, open() must not wait for a writer.
    static FileDescriptor open(const std::string& path, int flags) {
        return FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags));
    }
    FileDescriptor file_;
};

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <span>
#include <string>

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

    /// Copies to.size() bytes from `offset`. Returns false if the file ends before.
    bool read(std::uint64_t offset, std::span<std::byte> to) const {
        if (offset > static_cast<std::uint64_t>(INT64_MAX) - to.size()) return false;
        const auto got =
            pread(file_.get(), static_cast<void*>(to.data()), to.size(), static_cast<off_t>(offset));
        return got == static_cast<ssize_t>(to.size());
    }

  private:
    /// O_NONBLOCK: if a FIFO has replaced the file, open() must not wait for a writer.
    static FileDescriptor open(const std::string& path, int flags) {
        return FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags));
    }
    FileDescriptor file_;
};

/// A private copy of a struct of layout.hpp. The structs hold atomics, so fields are read one by one:
/// copy.get<std::uint64_t>(offsetof(RingHeader, sent)). A word that is written during the copy might be torn: then one
/// figure of one observation is wrong, and nothing else.
template <std::size_t Bytes>
struct StructCopy {
    alignas(8) std::byte bytes[Bytes] = {};

    template <class T>
    T get(std::size_t offset) const {
        T value{};
        if (offset + sizeof value <= Bytes) std::memcpy(&value, bytes + offset, sizeof value);
        return value;
    }
};

} // namespace tandem::shm

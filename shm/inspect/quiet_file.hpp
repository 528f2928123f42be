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

/// A file that is looked at without a trace: closing it wakes no watcher of writers, its access time stays,
/// and it is copied piece by piece and never mapped, because a mapped file that somebody truncates is a
/// SIGBUS where a copied one is a short read.
class QuietFile {
  public:
    explicit QuietFile(const std::string& path) : file_(open(path, O_NOATIME)) {
        if (!file_ && errno == EPERM) file_ = open(path, 0); // O_NOATIME is the owner's privilege
    }
    explicit operator bool() const { return static_cast<bool>(file_); } ///< Opened? Otherwise errno says why.
    int fd() const { return file_.get(); }

    /// Copies what stands at that place. False: the file ends before.
    bool read(std::uint64_t place, std::span<std::byte> to) const {
        if (place > static_cast<std::uint64_t>(INT64_MAX) - to.size()) return false;
        const auto got =
            pread(file_.get(), static_cast<void*>(to.data()), to.size(), static_cast<off_t>(place));
        return got == static_cast<ssize_t>(to.size());
    }

  private:
    static FileDescriptor open(const std::string& path, int flags) {
        return FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags));
    }
    FileDescriptor file_;
};

/// The private copy of a struct of layout.hpp. The structs hold atomics, so fields are taken out one by one:
/// copy.get<std::uint64_t>(offsetof(RingHeader, sent)). A word that is written during the copy might in
/// principle come out torn: one figure of one look is wrong then, and nothing else.
template <std::size_t Bytes>
struct Copied {
    alignas(8) std::byte bytes[Bytes] = {};

    template <class T>
    T get(std::size_t offset) const {
        T value{};
        if (offset + sizeof value <= Bytes) std::memcpy(&value, bytes + offset, sizeof value);
        return value;
    }
};

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

namespace tandem::shm {

/// A file, mapped as a whole for reading and writing, shared.
class MappedFile {
  public:
    /// sparse: parts of the file have no memory, and get none by mapping it, also in a process that locks its future memory (mlockall).
    /// Otherwise all page tables are filled, so that no access takes a page fault. Throws Error.
    MappedFile(int fd, const std::string& path, std::size_t bytes, bool sparse);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::byte* address() const { return address_; }
    std::size_t size() const { return size_; }

  private:
    std::byte* address_ = nullptr;
    std::size_t size_;
};

} // namespace tandem::shm

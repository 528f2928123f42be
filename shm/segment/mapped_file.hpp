// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/interprocess/mapped_region.hpp>
#include <cstddef>
#include <string>

namespace tandem::shm {

/// A whole file, mapped for shared reading and writing.
class MappedFile {
  public:
    /// With `sparse`, parts of the file have no memory, and mapping gives them none, even in a process that locks its future
    /// memory (mlockall). Otherwise fills all page tables, so that no access causes a page fault. Throws Error.
    MappedFile(int fd, const std::string& path, std::size_t bytes, bool sparse);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::byte* address() const { return address_; }
    std::size_t size() const { return size_; }

  private:
    boost::interprocess::mapped_region region_; ///< empty if the file is sparse
    std::byte* address_ = nullptr;
    std::size_t size_;
};

} // namespace tandem::shm

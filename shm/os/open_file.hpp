// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/interprocess/mapped_region.hpp>

namespace tandem::shm {

/// An open file descriptor in the form that boost::interprocess::mapped_region maps (a MemoryMappable). Does not own it.
class OpenFile {
  public:
    explicit OpenFile(int fd) : fd_(fd) {}
    boost::interprocess::mapping_handle_t get_mapping_handle() const { return {fd_, false}; }
    boost::interprocess::mode_t get_mode() const { return boost::interprocess::read_write; }

  private:
    int fd_;
};

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
// Whoever may write a segment's file may also truncate it, and then its users' next look at the lost part is
// a SIGBUS. (Files on tmpfs cannot be sealed against that: only memfd_create() makes such that can.)
#pragma once
#include <cstddef>

namespace tandem::shm {

/// [any-thread] From now on a lost part of a segment is replaced by zeros in this process, which every reader
/// of shared words takes for damage or for nothing, and Segment::superseded() says that it is time to leave.
/// A SIGBUS for another reason goes on to the handler that was there before. Off unless called: how a process
/// handles signals is its own business.
void install_truncation_guard();

/// Used by Mapping: memory that the guard looks after.
class GuardedRange {
  public:
    GuardedRange(void* begin, std::size_t bytes);
    ~GuardedRange();
    GuardedRange(const GuardedRange&) = delete;
    GuardedRange& operator=(const GuardedRange&) = delete;

  private:
    std::size_t place_;
};

} // namespace tandem::shm

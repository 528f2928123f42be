// SPDX-License-Identifier: Apache-2.0
// A process that may write a segment's file may also truncate it, and then its users' next access to the lost
// part is a SIGBUS. (Files on tmpfs cannot be sealed against that: only those of memfd_create() can.)
#pragma once
#include <cstddef>

namespace tandem::shm {

/// [any-thread] Installs a handler of SIGBUS that replaces a lost part of a segment by zeros in this process. Readers
/// take zeros for damage or for nothing new, and Segment::superseded() says to leave. Another SIGBUS is passed on to
/// the handler that was there before. Not installed by default, because signals are the program's choice.
void install_truncation_guard();

/// Used by Mapping: registers memory for the handler.
class TruncationGuardedRange {
  public:
    TruncationGuardedRange(void* begin, std::size_t bytes);
    ~TruncationGuardedRange();
    TruncationGuardedRange(const TruncationGuardedRange&) = delete;
    TruncationGuardedRange& operator=(const TruncationGuardedRange&) = delete;

  private:
    std::size_t index_;
};

} // namespace tandem::shm

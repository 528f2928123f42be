// SPDX-License-Identifier: Apache-2.0
// A process that may write a segment's file may also truncate it. The next access of another process to the lost part then
// raises SIGBUS. Files on tmpfs cannot be sealed against truncation; only files of memfd_create() can.
#pragma once
#include <cstddef>

namespace tandem::shm {

/// [any-thread] Installs a SIGBUS handler that replaces the lost part of a segment by zeros in this process. Readers treat
/// zeros as damage or as nothing new, and Segment::superseded() then says that the user must leave. Passes any other
/// SIGBUS to the earlier handler. Not installed by default, because signal handlers are the program's choice.
void install_truncation_guard();

/// Registers memory for the handler. Used by Mapping.
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

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"

#include <chrono>
#include <string>

namespace tandem::shm {

/// Wakes when a segment of one link appears or goes, or one of its holders left or died (inotify), so that
/// nobody has to poll for the peer. A hint, not a fact: look at Segment afterwards. After a death the lock
/// falls free some microseconds after the wake, so look again a few milliseconds later.
class Watcher {
  public:
    /// Throws Error if the system has no inotify instance left.
    explicit Watcher(const std::string& link);

    /// [one thread] Waits for such an event (those since the last wait count) or interrupt(). False: bound
    /// passed.
    bool wait(std::chrono::nanoseconds bound);

    /// [any-thread] Ends the wait, now or the next.
    void interrupt();

  private:
    bool drain();

    std::string prefix_;
    FileDescriptor events_, interrupt_;
};

} // namespace tandem::shm

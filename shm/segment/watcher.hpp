// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"

#include <chrono>
#include <string>

namespace tandem::shm {

/// Waits until a segment of one link appears or goes, or a side leaves or dies (by inotify), so that nobody
/// has to poll for the peer. It only tells when to look: Segment says what happened. After a death the lock
/// becomes free some microseconds after the wake-up, so look again a few milliseconds later.
class Watcher {
  public:
    /// Throws Error if the system has no inotify instance left.
    explicit Watcher(const std::string& link);

    /// [one thread] Waits for such an event (also one since the last wait) or interrupt(). False: the bound
    /// has passed.
    bool wait(std::chrono::nanoseconds bound);

    /// [any-thread] Ends the wait, now or the next.
    void interrupt();

  private:
    bool take_events();

    std::string prefix_;
    FileDescriptor events_, interrupt_;
};

} // namespace tandem::shm

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"
#include "shm/segment/file_watch.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace tandem::shm {

/// Waits until something happens to one generation of a link, so that nobody has to poll for the peer: by inotify on the
/// segment's file, and by a pidfd of the peer's process. It only tells when to look: Segment says what happened.
class Watcher {
  public:
    /// What ended a wait. departed: somebody may have left or died. A process that closes the file loses its lock some
    /// microseconds after that shows, so look again a few times.
    enum class Event { none, changed, departed };

    /// Throws Error if the system has no inotify instance left.
    explicit Watcher(const std::string& link);

    /// [one thread] Watches this open file from now on, and no other: somebody joins, publishes or leaves, truncates,
    /// supersedes or removes it. Throws Error.
    void watch_file(int fd);
    /// [one thread] Watches the end of this process, too. An errno value if the system refuses that.
    std::optional<int> watch_process(std::uint32_t pid);
    void stop_watching(); ///< [one thread] Forgets file and process.

    /// [one thread] Waits for such an event (also one since the last wait) or interrupt(), which counts as changed.
    Event wait(std::chrono::nanoseconds bound);

    /// [any-thread] Ends the wait, now or the next.
    void interrupt();

  private:
    Event take_events();
    bool add(int fd, std::uint32_t events) const;
    void forget_process();

    FileDescriptor interrupt_, process_;
    FileDescriptor sources_; ///< an epoll instance with the two above and the events of files
    FileWatch file_;         ///< uses interrupt_
};

} // namespace tandem::shm

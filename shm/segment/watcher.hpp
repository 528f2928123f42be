// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"
#include "shm/segment/file_watch.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace tandem::shm {

/// Waits until something happens to one generation of a link, so that no thread has to poll for the peer. Uses inotify on the
/// segment's file and a pidfd of the peer's process. It only reports when to look; Segment reports what happened.
class Watcher {
  public:
    /// What ended a wait. departed: a side may have left or died. A process that closes the file loses its lock some
    /// microseconds after this event, so look again a few times.
    enum class Event { none, changed, departed };

    /// Throws Error if the system has no inotify instance left.
    explicit Watcher(const std::string& link);

    /// [one thread] Watches this open file. Stops watching any earlier file and process. Events: a side joins, publishes or
    /// leaves, or a process truncates, supersedes or removes the file. Throws Error.
    void start_watching(int fd);
    /// [one thread] Also watches for the end of this process. Returns an errno value if the system refuses that.
    std::optional<int> watch_process(std::uint32_t pid);
    void stop_watching(); ///< [one thread] Stops watching the file and the process.

    /// [one thread] Waits for an event, including one since the last wait, or for interrupt(), which returns `changed`.
    Event wait(std::chrono::nanoseconds bound);

    /// [any-thread] Ends the current wait, or the next one.
    void interrupt();

  private:
    Event take_events();
    bool add(int fd, std::uint32_t events) const;
    void forget_process();

    FileDescriptor interrupt_, process_;
    FileDescriptor sources_; ///< an epoll instance with the two above and the file's events
    FileWatch file_;         ///< uses interrupt_
};

} // namespace tandem::shm

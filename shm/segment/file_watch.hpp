// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace tandem::shm {

/// Watches one file by inotify. All watches of a process share one inotify instance, of which a user has 128 by default:
/// each link of each process needs a watch.
class FileWatch {
  public:
    /// Throws Error, one line that begins with `what`, if the system has no inotify instance left. `signal`: an eventfd
    /// that is written when another thread has read events of this file.
    FileWatch(std::string what, int signal);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    /// Watches this open file from now on, for the events of `mask`. Throws Error.
    void start(int fd, std::uint32_t mask);
    void stop();

    /// Readable when there are events, of whichever file. Whoever is woken by it calls take() or stop().
    int fd() const;
    /// The bits of the events of this file since the last call; IN_Q_OVERFLOW if some were lost. Hands those of other
    /// files to their watches. [any-thread]
    std::uint32_t take();

  private:
    class Instance;
    const std::string what_;
    const int signal_;
    std::shared_ptr<Instance> instance_;
    int watch_ = -1; ///< the members below are guarded by the instance's mutex
    std::uint32_t pending_ = 0;
    bool signalled_ = false; ///< since the last take()
};

} // namespace tandem::shm

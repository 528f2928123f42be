// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace tandem::shm {

/// Watches one file by inotify. All watches of a process share one inotify instance, because each link needs a watch and a
/// user has only 128 instances by default.
class FileWatch {
  public:
    /// `signal` is an eventfd, written when another thread has read events of this file. Throws Error, one line that begins
    /// with `what`, if the system has no inotify instance left.
    FileWatch(std::string what, int signal);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    /// Watches this open file for the events of `mask`, instead of any earlier file. Throws Error.
    void start(int fd, std::uint32_t mask);
    void stop();

    /// Returns a descriptor that is readable when events of any file are pending. A thread that it wakes calls take() or stop().
    int fd() const;
    /// Returns the bits of the events of this file since the last call, with IN_Q_OVERFLOW if some were lost. Passes events of
    /// other files to their watches. [any-thread]
    std::uint32_t take();

  private:
    class Instance;
    const std::string what_;
    const int signal_;
    std::shared_ptr<Instance> instance_;
    int watch_ = -1; ///< the instance's mutex guards this and the members below
    std::uint32_t pending_ = 0;
    bool signalled_ = false; ///< since the last take()
};

} // namespace tandem::shm

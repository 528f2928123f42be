// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <pthread.h>

namespace tandem::process {

/// A thread whose stack has a given size. A process that locks its memory (mlockall) also locks the unused part of each stack,
/// which has 8 MiB by default. The destructor waits for the end of the thread.
class SizedThread {
  public:
    /// Throws NotStarted if no thread can be started.
    SizedThread(std::size_t stack_bytes, std::function<void()> work);
    ~SizedThread();
    SizedThread(const SizedThread&) = delete;
    SizedThread& operator=(const SizedThread&) = delete;

    bool is_this_thread() const { return pthread_equal(pthread_self(), thread_) != 0; }

  private:
    pthread_t thread_{};
};

} // namespace tandem::process

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <system_error>
#include <thread>

namespace tandem::process {

/// A thread or process could not be started. what() is one line: what failed, the limit, and the remedy.
class NotStarted : public std::system_error {
  public:
    /// `error`: an errno of pthread_create(), posix_spawn() or pidfd_open().
    NotStarted(int error, const std::string& what);
    const char* what() const noexcept override { return text_.c_str(); }

  private:
    std::string text_;
};

/// Starts a thread. Throws NotStarted. [any-thread]
std::thread start_thread(std::function<void()> work);

/// Starts a detached thread. Returns false if no thread can be started. [any-thread]
bool start_detached(std::function<void()> work);

} // namespace tandem::process

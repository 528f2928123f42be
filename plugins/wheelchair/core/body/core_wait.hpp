// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <sys/types.h>

namespace tandem::wheelchair {

/// Measures how long a thread was ready to run while another thread had the core (`run_delay` of
/// /proc/thread-self/schedstat). The kernel of a virtual machine does not see the time that other guests take. [one thread
/// at a time]
class CoreWait {
  public:
    CoreWait() = default;
    ~CoreWait();
    CoreWait(const CoreWait&) = delete;
    CoreWait& operator=(const CoreWait&) = delete;

    /// Returns the calling thread's waiting time since its last call [s], 0 at its first call; NaN if the kernel does not
    /// count it.
    double seconds_since_last_call();

  private:
    std::int64_t total_ns() const;

    pid_t thread_ = 0;
    int file_ = -1;
    std::int64_t last_ns_ = 0;
};

} // namespace tandem::wheelchair

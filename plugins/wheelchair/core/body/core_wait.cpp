// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/body/core_wait.hpp"

#include <algorithm>
#include <charconv>
#include <fcntl.h>
#include <limits>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace tandem::wheelchair {

CoreWait::~CoreWait() {
    if (file_ >= 0) ::close(file_);
}

double CoreWait::seconds_since_last_call() {
    if (const pid_t thread = ::gettid(); std::exchange(thread_, thread) != thread) {
        if (file_ >= 0) ::close(file_);
        file_ = ::open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC);
        last_ns_ = total_ns();
        return 0.0;
    }
    const std::int64_t now = total_ns();
    if (now < 0) return std::numeric_limits<double>::quiet_NaN();
    return 1e-9 * static_cast<double>(now - std::exchange(last_ns_, now));
}

/// Returns -1 if the kernel does not count it. The file has one line: time on a core [ns], time of waiting for one [ns],
/// number of times that the thread was given one (Linux, Documentation/scheduler/sched-stats.rst).
std::int64_t CoreWait::total_ns() const {
    char text[96];
    const ssize_t size = ::pread(file_, text, sizeof text, 0);
    if (size <= 0) return -1;
    std::string_view line(text, static_cast<std::size_t>(size));
    line.remove_prefix(std::min(line.find(' ') + 1, line.size()));
    std::int64_t waited = -1;
    std::from_chars(line.data(), line.data() + line.size(), waited);
    return waited;
}

} // namespace tandem::wheelchair

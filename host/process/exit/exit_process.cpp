// SPDX-License-Identifier: Apache-2.0
#include "host/process/exit/exit_process.hpp"

#include "host/process/exit/exit_timer.hpp"
#include "host/process/start_thread.hpp"

#include <algorithm>
#include <atomic>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace tandem::process {
namespace {

constexpr std::chrono::seconds flush_timeout{2};

// Static objects are destroyed in reverse order of their construction. This one is constructed before main()
// loads any component library, so its destructor runs after those of all libraries. The flag itself has no
// destructor and stays valid.
std::atomic<bool> libraries_are_destroyed{false};
std::unique_ptr<ExitTimer> exit_timer; // for set_exit_timeout(); is also destroyed after the libraries
struct DestroyedAfterLibraries {
    ~DestroyedAfterLibraries() { libraries_are_destroyed = true; }
} const destroyed_after_libraries;

std::atomic<void (*)()> log_flush{nullptr};

} // namespace

void set_log_flush(void (*flush)()) { log_flush = flush; }

void flush_streams() {
    if (ftrylockfile(stdout) == 0) {
        std::cout.flush(); // std::cout has a separate buffer after sync_with_stdio(false)
        funlockfile(stdout);
    }
    fcloseall(); // glibc: flushes all streams without taking their locks, as exit() does, and closes none
}

void flush_or_exit(int code) {
    // The flush blocks when standard output is a full pipe that nobody reads.
    const auto flushed = std::make_shared<std::atomic<bool>>(false);
    std::optional<ExitTimer> without_thread;
    if (!start_detached([code, flushed] {
            std::this_thread::sleep_for(flush_timeout);
            if (!*flushed) std::_Exit(code);
        }))
        without_thread.emplace(flush_timeout, "", code);
    if (const auto flush = log_flush.load()) flush();
    flush_streams();
    *flushed = true;
}

void exit_process(int code) {
    flush_or_exit(code);
    std::_Exit(code);
}

void set_exit_timeout(std::chrono::nanoseconds timeout, const std::string& message) {
    // Uses write() instead of the logger: the logger is a static object that may already be destroyed.
    const bool has_thread = start_detached([timeout, line = message + "\n"] {
        std::this_thread::sleep_for(timeout);
        if (libraries_are_destroyed) return;
        pollfd ready{STDERR_FILENO, POLLOUT, 0};
        // A ready pipe takes a line of this length without blocking.
        if (poll(&ready, 1, 0) > 0) [[maybe_unused]]
            const auto written =
                write(STDERR_FILENO, line.data(), std::min<std::size_t>(line.size(), PIPE_BUF));
        exit_process(1);
    });
    if (!has_thread) exit_timer = std::make_unique<ExitTimer>(timeout, message, 1);
}

} // namespace tandem::process

// SPDX-License-Identifier: Apache-2.0
#include "host/rt/leave.hpp"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <unistd.h>
#include <utility>

namespace tandem::rt {
namespace {

std::atomic<bool> exit_is_ours{true};

// Made before main(), so gone after all that a component's library has made. The flag outlives it.
std::atomic<bool> libraries_are_done{false};
struct Last {
    ~Last() { libraries_are_done = true; }
} const last;

} // namespace

void flush_streams() {
    if (ftrylockfile(stdout) == 0) {
        std::cout.flush(); // which may have a buffer of its own
        funlockfile(stdout);
    }
    fcloseall(); // glibc: flushes all without their locks, as exit() does, and closes none
}

void leave(int code) {
    std::thread([code] { // standard output may be a pipe that is full and read by nobody
        std::this_thread::sleep_for(std::chrono::seconds(2));
        std::_Exit(code);
    })
        .detach();
    flush_streams();
    std::_Exit(code);
}

void bound_exit(std::chrono::nanoseconds grace, std::string line) {
    // No logger: the program's own statics may be gone when it is needed.
    std::thread([grace, line = std::move(line) + "\n"] {
        std::this_thread::sleep_for(grace);
        if (libraries_are_done) return;
        [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
        leave(1);
    }).detach();
}

// What is registered last is called first; on_exit(3) tells the code, which atexit(3) does not.
SuddenExit::SuddenExit() {
    auto handler = [](int code, void*) {
        if (!exit_is_ours) leave(code);
    };
    exit_is_ours = on_exit(handler, nullptr) != 0; // refused when memory is out: an exit like any other then
}
SuddenExit::~SuddenExit() { exit_is_ours = true; }

} // namespace tandem::rt

// SPDX-License-Identifier: Apache-2.0
#include "host/process/exit/exit_guard.hpp"

#include "host/process/exit/exit_process.hpp"

#include <atomic>
#include <cstdlib>

namespace tandem::process {
namespace {

// False while an ExitGuard lives: a call of exit() then comes from a component, not from the host's main().
std::atomic<bool> host_has_ended{true};

} // namespace

// Exit handlers run in reverse order of registration, so this handler runs after those of libraries that are loaded
// later. on_exit() passes the exit code to its handler; atexit() does not.
ExitGuard::ExitGuard() {
    auto handler = [](int code, void*) {
        if (!host_has_ended) exit_process(code);
    };
    host_has_ended = on_exit(handler, nullptr) != 0; // if memory is exhausted, exit() is not guarded
}

ExitGuard::~ExitGuard() { host_has_ended = true; }

} // namespace tandem::process

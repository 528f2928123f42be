// SPDX-License-Identifier: Apache-2.0
// Ends a host process in which threads of components may still be running.
#pragma once

#include <chrono>
#include <string>

namespace tandem::process {

/// Writes out what files and standard output have buffered. Waits for no stream's lock: a thread of a
/// component that reads stdin holds the lock of stdin for ever. [any-thread]
void flush_streams();

/// Flushes, for at most two seconds, and ends the process with `code`. Runs no static destructor, because
/// threads that have not returned may still use static objects. [any-thread]
[[noreturn]] void exit_process(int code);

/// Bounds the static destructors of component libraries, which run after main(): when they take longer than
/// `timeout`, writes `message` as a line to standard error and ends the process with code 1. To be called
/// before main() returns, while these libraries are still loaded. [main-thread]
void set_exit_timeout(std::chrono::nanoseconds timeout, std::string message);

} // namespace tandem::process

// SPDX-License-Identifier: Apache-2.0
// Ends a host process in which threads of components may still be running.
#pragma once

#include <chrono>
#include <string>

namespace tandem::process {

/// Flushes the buffers of files and of standard output. Does not wait for the lock of any stream, because a component's
/// thread that reads stdin holds the lock of stdin forever. [any-thread]
void flush_streams();

/// Makes flush_or_exit() and exit_process() also call `flush`, within their time limit. [main-thread]
void set_log_flush(void (*flush)());

/// Flushes the buffers for at most two seconds and ends the process with `code`. Runs no static destructors, because
/// threads that have not returned may still use static objects. [any-thread]
[[noreturn]] void exit_process(int code);

/// Flushes the buffers before main() returns. If that takes longer than two seconds, because nobody reads a full pipe, ends
/// the process with `code`. [main-thread]
void flush_or_exit(int code);

/// Limits the time of the static destructors of component libraries, which run after main(). If they take longer than
/// `timeout`, writes `message` as a line to standard error and ends the process with code 1. Call it before main()
/// returns, while these libraries are still loaded. [main-thread]
void set_exit_timeout(std::chrono::nanoseconds timeout, const std::string& message);

} // namespace tandem::process

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <csignal>
#include <initializer_list>

namespace tandem::command {

/// Calls `handler` for the signals that ask a program to end: Ctrl-C, kill, and the end of its terminal, unless nohup(1)
/// started it. [main-thread]
inline void handle_end_signals(void (*handler)(int)) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(number, handler) == SIG_IGN && number == SIGHUP) std::signal(number, SIG_IGN);
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <initializer_list>
#include <signal.h>

namespace tandem::command {

/// Calls `handler` for the first signal of each kind that asks a program to end: Ctrl-C, kill, and the end of its
/// terminal, unless nohup(1) started it. The signal also interrupts the opening of a pipe that nobody reads. The second
/// signal of a kind ends the program at once. [main-thread]
inline void handle_end_signals(void (*handler)(int)) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {
        }, before{};
        action.sa_handler = handler;
        action.sa_flags = SA_RESETHAND;
        sigaction(number, &action, &before);
        if (before.sa_handler == SIG_IGN && number == SIGHUP) sigaction(number, &before, nullptr);
    }
}

} // namespace tandem::command

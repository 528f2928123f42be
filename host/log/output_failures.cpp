// SPDX-License-Identifier: Apache-2.0
#include "host/log/output_failures.hpp"

#include <csignal>
#include <initializer_list>

namespace tandem::log {

void outlive_output_failures() {
    // Installs a handler, because exec() resets it to the default. An ignored signal would stay ignored in the programs
    // that components start, and `yes | head` relies on the default.
    struct sigaction nothing {};
    nothing.sa_handler = [](int) {};
    nothing.sa_flags = SA_RESTART;
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &nothing, nullptr);
}

} // namespace tandem::log

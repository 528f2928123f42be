// SPDX-License-Identifier: Apache-2.0
#include "host/log/output_failures.hpp"

#include <csignal>
#include <fcntl.h>
#include <initializer_list>
#include <unistd.h>

namespace tandem::log {

void outlive_output_failures() {
    // Installs a handler, because exec() resets it to the default. An ignored signal would stay ignored in the programs
    // that components start, and `yes | head` relies on the default.
    struct sigaction nothing {};
    nothing.sa_handler = [](int) {};
    nothing.sa_flags = SA_RESTART;
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &nothing, nullptr);
}

void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY); // takes the lowest free number
}

} // namespace tandem::log

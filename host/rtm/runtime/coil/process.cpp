// SPDX-License-Identifier: Apache-2.0
// Child processes for components that start programs. Neither function is for commands from untrusted
// sources.
#include "host/process/child_process.hpp"
#include <coil/Process.h>
#include <cstdio>

namespace coil {

// Starts a new session, because a manager's child should outlive its terminal.
int launch_shell(const std::string& command) {
    // Splits at blanks without a shell, although the name is OpenRTM-aist's. Quotes and variables have no meaning.
    const vstring arguments = split(command, " ", true);
    return !arguments.empty() && tandem::process::start_detached(arguments) ? 0 : -1;
}

int create_process(const std::string& command, std::vector<std::string>& out) {
    // "e": close-on-exec, so that processes started meanwhile do not keep the pipe open.
    std::FILE* output = ::popen(command.c_str(), "re");
    if (output == nullptr) return -1;
    char* line = nullptr;
    std::size_t room = 0;
    while (::getline(&line, &room, output) >= 0) {
        std::string text(line);
        if (!text.empty() && text.back() == '\n') text.pop_back();
        out.push_back(text);
    }
    std::free(line);
    ::pclose(output);
    return 0;
}

int daemon(int nochdir, int noclose) { return ::daemon(nochdir, noclose); }

} // namespace coil

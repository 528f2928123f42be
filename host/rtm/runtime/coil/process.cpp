// SPDX-License-Identifier: Apache-2.0
#include "host/process/child_process.hpp"
#include <coil/Process.h>
#include <cstdio>

namespace coil {

// In a session of its own: a manager's child should outlive its terminal.
int launch_shell(const std::string& command) {
    const vstring arguments = split(command, " ", true);
    return !arguments.empty() && tandem::process::start_detached(arguments) ? 0 : -1;
}

int create_process(const std::string& command, std::vector<std::string>& out) {
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

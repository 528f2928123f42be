// SPDX-License-Identifier: Apache-2.0
#include <coil/Process.h>
#include <cstdio>
#include <spawn.h>

extern char** environ;

namespace coil {

int launch_shell(const std::string& command) {
    Argv argv(split(command, " ", true));
    if (argv.size() == 0) return -1;
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes,
                               POSIX_SPAWN_SETSID); // it outlives the terminal, as a manager's child should
    ::pid_t pid = 0;
    const int error = ::posix_spawnp(&pid, argv.get()[0], nullptr, &attributes, argv.get(), environ);
    ::posix_spawnattr_destroy(&attributes);
    return error == 0 ? 0 : -1;
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

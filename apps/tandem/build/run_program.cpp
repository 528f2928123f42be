// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/run_program.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace tandem::command {
namespace {

/// A file without a name, for all that the program says.
std::unique_ptr<FILE, int (*)(FILE*)> scratch() {
    std::unique_ptr<FILE, int (*)(FILE*)> file(std::tmpfile(), std::fclose);
    if (!file) throw std::runtime_error(std::string("no temporary file: ") + std::strerror(errno));
    return file;
}

std::string content(FILE* file) {
    std::string text;
    std::array<char, 4096> chunk;
    std::rewind(file);
    while (const auto got = std::fread(chunk.data(), 1, chunk.size(), file)) text.append(chunk.data(), got);
    return text;
}

} // namespace

ProgramEnd run_program(const std::vector<std::string>& command) {
    const auto output = scratch();
    std::vector<char*> argv;
    for (const auto& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int target : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_adddup2(&actions, fileno(output.get()), target);
    pid_t pid = -1;
    const int error = posix_spawnp(&pid, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw std::runtime_error(command[0] + " cannot be started: " + std::strerror(error) +
                                 "; install it (apt install " + command[0] + ")");
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), content(output.get())};
}

std::string first_error(const std::string& output) {
    std::istringstream lines(output);
    std::string line, last;
    while (std::getline(lines, line)) {
        for (const char* word : {"error: ", "undefined reference", "CMake Error", "undefined symbol",
                                 // omniidl's
                                 ": Syntax error", ": Error in ", ": No such file or directory"})
            if (line.find(word) != std::string::npos) return line;
        if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    }
    return last;
}

} // namespace tandem::command

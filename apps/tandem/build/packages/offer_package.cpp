// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/packages/offer_package.hpp"

#include "apps/tandem/output/print_note.hpp"
#include "host/process/child_process.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <set>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace tandem::command {
namespace {

// The child stays in the foreground of the terminal: sudo may ask there, and Ctrl-C reaches it.
bool run_in_terminal(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), words[0]);
    if (child == 0) {
        execvp(arguments[0], arguments.data());
        dprintf(STDERR_FILENO, "tandem: %s: %s\n", arguments[0], std::strerror(errno));
        _exit(127);
    }
    const auto ended = process::ChildProcess(child).wait(std::chrono::hours(1));
    return ended && ended->success();
}

} // namespace

bool offer_package(const std::string& package) {
    if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) return false;
    static std::set<std::string> refused; // several components of a folder may lack it
    if (refused.contains(package)) return false;
    std::vector<std::string> command{"apt-get", "install", "--yes", "--no-remove", package};
    if (geteuid() != 0) command.insert(command.begin(), "sudo");
    print_note("tandem: the Debian package {} is not installed; install it now ({}apt-get install)? [y/N] ",
               package, geteuid() != 0 ? "sudo " : "");
    std::string answer;
    std::getline(std::cin, answer);
    if (answer != "y" && answer != "Y" && answer != "yes") refused.insert(package);
    return !refused.contains(package) && run_in_terminal(std::move(command));
}

} // namespace tandem::command

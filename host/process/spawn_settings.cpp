// SPDX-License-Identifier: Apache-2.0
#include "host/process/spawn_settings.hpp"

#include <csignal>
#include <unistd.h>

namespace tandem::process {

SpawnSettings::SpawnSettings() {
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_init(&actions_);
}

SpawnSettings::~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
}

void SpawnSettings::reset_signals_and_set_group() {
    // A child inherits blocked and ignored signals through exec, and hosts block the signals that end them.
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
}

void SpawnSettings::set_session() { posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSID); }

void SpawnSettings::redirect(int source, int target) {
    posix_spawn_file_actions_adddup2(&actions_, source, target);
}

void SpawnSettings::set_folder(const std::string& folder) {
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
}

int SpawnSettings::spawn(pid_t& pid, const std::vector<std::string>& command) const {
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const auto& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    return posix_spawnp(&pid, arguments[0], &actions_, &attributes_, arguments.data(), environ);
}

} // namespace tandem::process

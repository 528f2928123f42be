// SPDX-License-Identifier: Apache-2.0
// Internal to host/process.
#pragma once

#include <spawn.h>
#include <string>
#include <vector>

namespace tandem::process {

/// Owns the two objects that tell posix_spawn() how to start a program.
class SpawnSettings {
  public:
    SpawnSettings();
    ~SpawnSettings();
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    /// The program starts with no signal blocked or ignored, as the leader of a new process group.
    void reset_signals_and_set_group();
    /// The program starts as the leader of a new session.
    void set_session();
    /// Gives the program descriptor `source` of this process as its descriptor `target`.
    void redirect(int source, int target);
    void set_folder(const std::string& folder);

    /// Starts command[0], which is looked up on PATH if it has no slash. Returns 0, or the error number.
    int spawn(pid_t& pid, const std::vector<std::string>& command) const;

  private:
    posix_spawnattr_t attributes_;
    posix_spawn_file_actions_t actions_;
};

} // namespace tandem::process

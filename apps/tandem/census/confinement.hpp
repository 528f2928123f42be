// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace tandem::command {

/// Limits what components of child processes can do to this machine, until the program ends. Gives child processes no
/// input, at most 4 GiB of address space each, files of at most 256 MiB and no core dumps. [main-thread]
class Confinement {
  public:
    /// Child processes write temporary files, sockets and builds into a new folder. Throws std::runtime_error.
    Confinement();
    /// Kills what is left and removes the folder.
    ~Confinement();
    Confinement(const Confinement&) = delete;
    Confinement& operator=(const Confinement&) = delete;

    /// Kills the processes that a component left running, including those that became daemons, and empties the folder. No
    /// other child process may run.
    void clean();
    /// Returns the folder.
    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
};

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// What a command could not read of a damaged recording. The command uses the rest, and then reports this.
class Losses {
  public:
    explicit Losses(std::filesystem::path file) : file_(std::move(file)) {}

    void add(const std::vector<std::string>& problems);
    void add(const std::string& problem);
    /// Prints one line to standard error that names the first loss and the number of others. Returns the exit code: 0
    /// without a loss, otherwise 1.
    int report() const;

  private:
    const std::filesystem::path file_;
    std::vector<std::string> problems_;
};

} // namespace tandem::command

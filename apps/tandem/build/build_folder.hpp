// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// The folder in which CMake works. Unless the user named a folder, it is temporary and removed with this
/// object.
class BuildFolder {
  public:
    /// Creates the folder. Throws std::runtime_error if that is not possible.
    explicit BuildFolder(const std::filesystem::path& wanted);
    ~BuildFolder();
    BuildFolder(const BuildFolder&) = delete;
    BuildFolder& operator=(const BuildFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    bool temporary_;
    std::filesystem::path path_;
};

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/file_descriptor.hpp"

#include <filesystem>

namespace tandem::command {

/// A new folder in which a command writes a system, until DIR gets the complete files by rename. A killed command leaves no
/// half-written file; the next one removes what it has left.
class StagedFolder {
  public:
    /// Throws std::runtime_error if another command writes DIR, or if the new folder cannot be created.
    explicit StagedFolder(const std::filesystem::path& folder);
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    /// Creates the new folder's `opros` or `rtm`. Throws std::runtime_error if DIR has one that is not empty.
    std::filesystem::path add_side(const char* side);
    /// The new folder.
    const std::filesystem::path& path() const { return path_; }

    /// Moves the new sides to DIR.
    void publish();
    /// Replaces the files of DIR that differ, each by rename, and keeps the previous ones as FILE~.
    void publish_files();

  private:
    std::filesystem::path folder_, path_; // absolute
    process::FileDescriptor lock_;
};

} // namespace tandem::command

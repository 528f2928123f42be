// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// Creates one side of a folder for tandem run, DIR/opros or DIR/rtm. Unless keep() is called, removes it with its
/// contents. Leaves the other side and other contents of DIR unchanged.
class ImportFolder {
  public:
    /// `output` empty: NAME-tandem in the current folder, with NAME from the imported folder. Throws std::runtime_error
    /// if the side exists and is not empty, or cannot be created.
    ImportFolder(const std::filesystem::path& output, const std::filesystem::path& imported,
                 const char* side);
    ~ImportFolder();
    ImportFolder(const ImportFolder&) = delete;
    ImportFolder& operator=(const ImportFolder&) = delete;

    const std::filesystem::path& output() const { return output_; } ///< as the user wrote it
    const std::filesystem::path& path() const { return path_; }     ///< absolute path of the side
    void keep() { keep_ = true; }

  private:
    std::filesystem::path output_, path_;
    bool made_output_ = false, keep_ = false;
};

} // namespace tandem::command

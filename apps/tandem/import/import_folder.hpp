// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// One side of a folder for tandem run, DIR/opros or DIR/rtm: made new, and removed again with all that is in it unless
/// keep() is called. DIR and the other side stay as they are.
class ImportFolder {
  public:
    /// `output` empty: NAME-tandem in the current folder, after the folder that is imported. Throws std::runtime_error if
    /// the side exists and is not empty, or cannot be made.
    ImportFolder(const std::filesystem::path& output, const std::filesystem::path& imported,
                 const char* side);
    ~ImportFolder();
    ImportFolder(const ImportFolder&) = delete;
    ImportFolder& operator=(const ImportFolder&) = delete;

    const std::filesystem::path& output() const { return output_; } ///< as the user has written it
    const std::filesystem::path& path() const { return path_; }     ///< of the side, absolute
    void keep() { keep_ = true; }

  private:
    std::filesystem::path output_, path_;
    bool made_output_ = false, keep_ = false;
};

/// Throws std::runtime_error unless the name can be that of a link.
void require_link_name(const std::string& name);

} // namespace tandem::command

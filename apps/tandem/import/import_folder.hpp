// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/import/report.hpp"
#include "apps/tandem/system/staged_folder.hpp"

#include <filesystem>
#include <functional>

namespace tandem::command {

/// Creates one side of a folder for tandem run, DIR/opros or DIR/rtm, which gets this name when it is complete. Leaves the other
/// side and other contents of DIR unchanged.
class ImportFolder {
  public:
    /// `output` empty: NAME-tandem in the current folder, with NAME from the imported folder. Throws std::runtime_error
    /// if the side exists and is not empty, or cannot be created.
    ImportFolder(const std::filesystem::path& output, const std::filesystem::path& imported,
                 const char* side);

    const std::filesystem::path& output() const { return output_; } ///< as the user wrote it
    const std::filesystem::path& path() const { return path_; } ///< absolute; of the side while it is written

    /// Calls write(), which writes the files to path() and reports them, and publishes the side. Exceptions and the report then
    /// name the files of the published side.
    void complete(ImportReport& report, const std::function<void()>& write);

  private:
    std::filesystem::path output_;
    StagedFolder staged_;
    std::filesystem::path path_, place_;
};

} // namespace tandem::command

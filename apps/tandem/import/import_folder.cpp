// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/import_folder.hpp"

#include <stdexcept>
#include <string>

namespace tandem::command {

namespace fs = std::filesystem;

ImportFolder::ImportFolder(const fs::path& output, const fs::path& imported, const char* side)
    : output_(output.empty() ? fs::path(fs::canonical(imported).filename().string() + "-tandem") : output),
      path_(fs::absolute(output_ / side).lexically_normal()) {
    std::error_code error;
    if (fs::exists(path_) && !(fs::is_directory(path_) && fs::is_empty(path_, error)))
        throw std::runtime_error(path_.string() +
                                 " exists and is not empty; remove it, or name another folder");
    made_output_ = !fs::exists(output_);
    if (!fs::create_directories(path_, error) && error)
        throw std::runtime_error("folder " + path_.string() + " cannot be created: " + error.message());
}

ImportFolder::~ImportFolder() {
    std::error_code ignored; // a failed removal must not hide the original error
    if (!keep_) fs::remove_all(path_, ignored);
    if (!keep_ && made_output_) fs::remove(path_.parent_path(), ignored); // only if it is empty
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/build_folder.hpp"
#include "apps/tandem/build/plain_path.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace tandem::command {

namespace fs = std::filesystem;

BuildFolder::BuildFolder(const fs::path& wanted) : temporary_(wanted.empty()) {
    if (!temporary_) {
        fs::create_directories(wanted);
        path_ = fs::absolute(wanted);
        return;
    }
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "tandem-build-XXXXXX").string();
    if (error) throw std::runtime_error("TMPDIR does not name a folder to build in: " + error.message());
    require_cmake_path(name);
    if (!mkdtemp(name.data())) throw std::runtime_error("temporary folder " + name + " cannot be created");
    path_ = name;
}

BuildFolder::~BuildFolder() {
    std::error_code ignored;
    if (temporary_) fs::remove_all(path_, ignored);
}

} // namespace tandem::command

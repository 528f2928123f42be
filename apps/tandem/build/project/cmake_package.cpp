// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/project/cmake_package.hpp"

#include <stdexcept>

namespace tandem::command {

std::filesystem::path cmake_package_folder() {
    const auto prefix = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
    auto folder = prefix / TANDEM_PACKAGE_DIR;
    if (std::filesystem::is_regular_file(folder / "TandemConfig.cmake")) return folder;
    throw std::runtime_error("cannot find " + (folder / "TandemConfig.cmake").string() +
                             ", which builds of components need; reinstall Tandem (cmake --install)");
}

} // namespace tandem::command

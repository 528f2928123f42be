// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/idl/commands.hpp"

#include "apps/tandem/build/plain_path.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "host/process/run_command.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

fs::path prefix() { return fs::read_symlink("/proc/self/exe").parent_path().parent_path(); }

fs::path back_end_folder() {
    auto folder = prefix() / TANDEM_IDL_TOOLS_DIR;
    if (fs::is_regular_file(folder / "tandem_opros.py")) return folder;
    throw std::runtime_error(
        fmt::format("cannot find {}/tandem_opros.py; reinstall Tandem (cmake --install)", folder.string()));
}

/// Returns the folders of OpenRTM-aist's IDL files (`rtm/idl/BasicDataType.idl`), installed or in a build folder.
std::vector<fs::path> rtm_idl_folders() {
    std::vector<fs::path> folders;
    for (const char* place : {"include/tandem/rtm", "host/rtm/include"})
        for (const char* below : {"", "rtm/idl", "rtm/ext"})
            if (fs::is_directory(prefix() / place / below)) folders.push_back(prefix() / place / below);
    return folders;
}

} // namespace

int idl2opros(const Idl2OprosOptions& options) {
    if (!fs::is_regular_file(options.file))
        throw std::runtime_error(fmt::format("file {} does not exist", options.file.string()));
    const auto file = fs::absolute(options.file).lexically_normal(); // no name begins with '-'
    std::vector<fs::path> include_dirs(options.include_dirs.begin(), options.include_dirs.end());
    include_dirs.push_back(file.parent_path());
    for (const auto& folder : rtm_idl_folders()) include_dirs.push_back(folder);
    require_idl_path(file);
    for (auto& folder : include_dirs) {
        folder = fs::absolute(folder);
        require_idl_path(folder);
    }
    fs::create_directories(options.folder);
    std::vector<std::string> command{"env",
                                     "PYTHONDONTWRITEBYTECODE=1",
                                     "omniidl",
                                     "-nf",
                                     "-p" + back_end_folder().string(),
                                     "-btandem_opros",
                                     "-C" + options.folder.string()};
    for (const auto& folder : include_dirs) command.push_back("-I" + folder.string());
    command.push_back(file.string());
    const auto result = process::run_command(command);
    if (!result.succeeded()) throw std::runtime_error(fmt::format("omniidl: {}", result.failure()));
    print_text(result.output);
    print_note("{}", result.errors);
    return 0;
}

} // namespace tandem::command

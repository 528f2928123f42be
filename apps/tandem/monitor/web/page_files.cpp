// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/page_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace tandem::monitor {

std::map<std::string, PageFile, std::less<>> read_page_files() {
    namespace fs = std::filesystem;
    static const std::map<std::string, const char*> types{{".html", "text/html; charset=utf-8"},
                                                          {".css", "text/css; charset=utf-8"},
                                                          {".js", "text/javascript; charset=utf-8"}};
    std::map<std::string, PageFile, std::less<>> files;
    const fs::path folder =
        fs::read_symlink("/proc/self/exe").parent_path().parent_path() / TANDEM_MONITOR_PAGE_DIR;
    const auto read = [&](const fs::path& path, const std::string& address) {
        std::ifstream file(path, std::ios::binary);
        if (!file)
            throw std::runtime_error(fmt::format(
                "cannot read {}, a file of the monitor's page; reinstall Tandem (cmake --install)",
                path.string()));
        files[address] = {types.at(path.extension()), std::string(std::istreambuf_iterator<char>(file), {})};
    };
    read(folder / "index.html", "/");
    // lib has the libraries from npm, if npm was available during the build. Otherwise the page reports it.
    std::error_code missing;
    for (const auto& entry : fs::recursive_directory_iterator(folder, missing))
        if (types.count(entry.path().extension()) != 0)
            read(entry.path(), "/" + entry.path().lexically_relative(folder).string());
    return files;
}

} // namespace tandem::monitor

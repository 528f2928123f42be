// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/page_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace tandem::monitor {

std::map<std::string, PageFile, std::less<>> read_page_files() {
    constexpr const char* script = "text/javascript; charset=utf-8";
    std::map<std::string, PageFile, std::less<>> files;
    const auto folder =
        std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / TANDEM_MONITOR_PAGE_DIR;
    const auto read = [&](const char* path, const char* name, const char* type) {
        std::ifstream file(folder / name, std::ios::binary);
        if (!file)
            throw std::runtime_error(fmt::format(
                "cannot read {}, a file of the monitor's page; reinstall Tandem (cmake --install)",
                (folder / name).string()));
        files[path] = {type, std::string(std::istreambuf_iterator<char>(file), {})};
    };
    read("/", "index.html", "text/html; charset=utf-8");
    read("/style.css", "style.css", "text/css; charset=utf-8");
    for (const char* name : {"app.js", "chair.js", "control.js", "dom.js", "graph.js", "plot.js", "server.js",
                             "stick.js", "tables.js", "ticks.js", "topology.js", "values.js"})
        read(("/" + std::string(name)).c_str(), name, script);
    // These libraries exist if npm was available during the build. Otherwise the page reports it.
    for (const char* name : {"lib/elk-api.js", "lib/elk-worker.min.js"})
        if (std::filesystem::exists(folder / name)) read(("/" + std::string(name)).c_str(), name, script);
    return files;
}

} // namespace tandem::monitor

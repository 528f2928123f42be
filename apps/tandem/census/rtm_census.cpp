// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/census/candidate.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/modules.hpp"
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns the folders that contain sources, or whose src/ does.
std::set<fs::path> component_folders(const fs::path& top) {
    std::set<fs::path> folders;
    for (const auto& file : list_files_below(top)) {
        if (!is_source(file)) continue;
        const auto parent = file.parent_path();
        folders.insert(parent.filename() == "src" ? parent.parent_path() : parent);
    }
    return folders;
}

std::vector<Candidate> find_rtm(const fs::path& top, std::size_t&) {
    std::vector<Candidate> found;
    for (const auto& folder : component_folders(top))
        for (const auto& module : find_modules(folder)) {
            // Modules further below belong to another folder of this loop.
            const auto place = module.source.parent_path();
            if (place == folder || place == folder / "src") found.push_back({module.name, folder});
        }
    return found;
}

std::vector<std::string> load_rtm(const Candidate&, const fs::path& library) {
    std::vector<std::string> types, instances;
    for (const auto& type : probe_rtc_types(library, {})) {
        if (type.name.empty())
            throw std::runtime_error("its module function registers a component without implementation_id");
        instances.push_back(type.name + "0");
        types.push_back(type.name + "?instance_name=" + instances.back()); // its type_name may be another
    }
    if (types.empty()) throw std::runtime_error("its module function registers no component");
    const auto conf = library.parent_path() / "census.conf";
    // 100 Hz is enough to see cycles. No name server of this network learns of the component. Its log says why it fails.
    write_file(conf, fmt::format("manager.modules.load_path: {}\nmanager.modules.preload: {}\n"
                                 "manager.components.precreate: {}\nmanager.components.preactivation: {}\n"
                                 "manager.shutdown_auto: NO\nnaming.enable: NO\nlogger.log_level: ERROR\n"
                                 "exec_cxt.periodic.rate: 100\n",
                                 library.parent_path().string(), library.filename().string(),
                                 fmt::join(types, ","), fmt::join(instances, ",")));
    return {"rtm_host", "-f", conf.string(), "-a"};
}

} // namespace

const CensusModel rtm_census_model{"rtm", "--name", find_rtm, load_rtm};

} // namespace tandem::command

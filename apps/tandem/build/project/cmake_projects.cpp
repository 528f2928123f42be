// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/project/cmake_projects.hpp"
#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/cmake_commands.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/project/cmake_package.hpp"
#include "apps/tandem/build/project/tolerant_project.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/process/run_command.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

constexpr double max_configure_s = 120;

bool begins_project(const fs::path& folder) {
    for (auto line : read_lines(folder / "CMakeLists.txt")) {
        std::erase_if(line, [](char c) { return c == ' ' || c == '\t'; });
        if (to_lower(line.substr(0, 8)) == "project(") return true;
    }
    return false;
}

// Returns the folders of the projects around a source, the nearest first. Sources outside of the component's folder
// belong to the project of the folder.
Paths projects_around(const fs::path& source, const fs::path& folder) {
    const auto outermost = ancestors_in_checkout(folder).front();
    const bool outside = *source.lexically_relative(outermost).begin() == "..";
    Paths found;
    for (auto at = outside ? fs::canonical(folder) : source.parent_path();; at = at.parent_path()) {
        if (begins_project(at)) found.push_back(at);
        if (at == outermost || at == at.root_path()) break;
    }
    if (found.empty() && fs::exists(folder / "CMakeLists.txt")) found.push_back(fs::canonical(folder));
    return found;
}

const ProjectTarget* best_target(const std::vector<ProjectTarget>& targets, const fs::path& source,
                                 const std::string& name) {
    const ProjectTarget* best = nullptr;
    const auto rank = [&](const ProjectTarget& target) {
        return std::tuple(target.kind, target.name != name);
    };
    for (const auto& target : targets)
        if (std::find(target.sources.begin(), target.sources.end(), source) != target.sources.end() &&
            (!best || rank(target) < rank(*best)))
            best = &target;
    return best;
}

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

// A namespace without network, if the kernel permits it.
std::vector<std::string> without_network() {
    std::vector<std::string> command{"unshare", "--map-current-user", "--net"};
    auto trial = command;
    trial.emplace_back("true");
    try {
        return process::run_command(trial).succeeded() ? command : std::vector<std::string>{};
    } catch (const std::system_error&) {
        return {};
    }
}

// Projects find OpenRTM by find_package(), by pkg-config or by the program rtm-config.
std::vector<std::string> configure_command(const fs::path& project, const fs::path& scratch) {
    const auto packages = cmake_package_folder().parent_path(),
               libraries = packages.parent_path().parent_path();
    auto command = without_network();
    for (const std::string& word : std::initializer_list<std::string>{
             "cmake",
             "-E",
             "env",
             "GIT_ALLOW_PROTOCOL=file",
             "http_proxy=http://127.0.0.1:9",
             "https_proxy=http://127.0.0.1:9",
             "PATH=" + fs::read_symlink("/proc/self/exe").parent_path().string() + ":" + environment("PATH"),
             "PKG_CONFIG_PATH=" + (libraries / "pkgconfig").string() + ":" + environment("PKG_CONFIG_PATH"),
             "cmake",
             "-S",
             project.string(),
             "-B",
             scratch.string(),
             "-DCMAKE_PROJECT_INCLUDE_BEFORE=" + (scratch / "tolerant.cmake").string(),
             "-DOpenRTM_DIR=" + (packages / "OpenRTM").string(),
             "-DOpenRTM-aist_DIR=" + (packages / "OpenRTM-aist").string(),
             "-DTandem_DIR=" + (packages / "Tandem").string(),
             "-Dcatkin_DIR=" + (packages / "Tandem" / "catkin").string(),
             "-DFETCHCONTENT_FULLY_DISCONNECTED=ON",
             "-DCMAKE_EXPORT_NO_PACKAGE_REGISTRY=ON",
             "-DBUILD_DOCUMENTATION=OFF",
             "-DCMAKE_POLICY_VERSION_MINIMUM=3.5",
             "--no-warn-unused-cli"})
        command.push_back(word);
    return command;
}

std::string missing_packages(const std::string& output) {
    std::istringstream lines(output);
    std::set<std::string> packages;
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(missing_package, 0) == 0) packages.insert(line.substr(sizeof missing_package - 1));
    std::string names;
    for (const auto& package : packages) names += (names.empty() ? "" : ", ") + package;
    return names;
}

} // namespace

CMakeProjects::CMakeProjects(fs::path build, double timeout_s)
    : build_(std::move(build)), timeout_s_(std::min(timeout_s, max_configure_s)) {}

std::optional<ProjectTarget> CMakeProjects::find_target(const fs::path& folder, const Paths& sources,
                                                        const std::string& name) {
    for (const auto& source : sources) {
        auto around = projects_around(source, folder);
        if (around.size() > 2) around = {around.front(), around.back()};
        for (const auto& project : around)
            if (const auto* target = best_target(configure(project).targets, source, name)) return *target;
    }
    return std::nullopt;
}

const CMakeProjects::Project& CMakeProjects::configure(const fs::path& folder) {
    const auto known = projects_.find(folder);
    if (known != projects_.end()) return known->second;
    if (!scratch_) scratch_.emplace(build_);
    const auto scratch = scratch_->path() / std::to_string(projects_.size() + 1);
    request_codemodel(scratch);
    fs::remove(scratch / "CMakeCache.txt"); // of a folder that is kept: it may be another project's
    write_file(scratch / "tolerant.cmake", tolerant_project);
    process::CommandOptions options;
    options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(timeout_s_ * 1000));
    options.merge_errors = true;
    options.stop_on_signal = true;
    Project project;
    const std::string file = (folder / "CMakeLists.txt").string();
    const auto result = process::run_command(configure_command(folder, scratch), options);
    if (result.stop_signal != 0) throw std::runtime_error("configuring " + file + " " + result.failure());
    if (const auto missing = missing_packages(result.output); !missing.empty())
        project.problem = file + " requires packages that were not found: " + missing;
    if (result.succeeded())
        project.targets = read_codemodel(scratch);
    else
        project.problem = file + " cannot be configured: " +
                          (result.timed_out ? "it takes too long" : first_error(result.output));
    return projects_.emplace(folder, std::move(project)).first->second;
}

std::string CMakeProjects::problem() const {
    for (const auto& [folder, project] : projects_)
        if (!project.problem.empty()) return project.problem;
    return "";
}

} // namespace tandem::command

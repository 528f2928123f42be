// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/plugin_project.hpp"
#include "host/text/quote.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns a keyword of the CMake function with its values; "" without values.
std::string cmake_argument(const char* keyword, const std::vector<std::string>& values) {
    if (values.empty()) return "";
    std::string text = std::string("\n  ") + keyword;
    for (const auto& value : values) text += " " + text::quote_cmake(value);
    return text;
}

std::vector<std::string> absolute_names(const std::vector<fs::path>& files) {
    std::vector<std::string> names;
    names.reserve(files.size());
    for (const auto& file : files) names.push_back(fs::absolute(file).string());
    return names;
}

// Enables C only if needed, because CMake tests each compiler for half a second.
const char* languages(const std::vector<fs::path>& sources) {
    const auto is_c = [](const fs::path& source) { return source.extension() == ".c"; };
    return std::any_of(sources.begin(), sources.end(), is_c) ? "C CXX" : "CXX";
}

// Returns options for the C++ sources: those of the component's project, headers to include first, and folders of
// installed libraries. These come after all other folders, because a header in one must not hide another one.
std::string compile_options(const Plugin& plugin) {
    auto options = plugin.sources.target.options;
    if (plugin.needs_cv_h) options.emplace_back("SHELL:-include cv.h -include highgui.h");
    if (!plugin.missing_names.empty()) options.push_back(std::string("SHELL:-include ") + names_header);
    std::string text;
    for (const auto& option : options)
        text +=
            "add_compile_options(" + text::quote_cmake("$<$<COMPILE_LANGUAGE:CXX>:" + option + ">") + ")\n";
    for (const auto& [dir, library] : plugin.installed)
        text += "add_compile_options(" + text::quote_cmake("SHELL:-idirafter " + dir.string()) + ")\n";
    return text;
}

// Components are older than C++17, which removed exception specifications. Our headers need C++14.
int standard_of(const Plugin& plugin, const PluginBuildOptions& options) {
    return options.standard != 0 ? options.standard : std::max(14, plugin.sources.target.standard);
}

// Returns the libraries to link. Projects also name libraries that their sources do not need here.
std::string libraries(const Plugin& plugin, const PluginBuildOptions& options) {
    const auto& target = plugin.sources.target;
    std::vector<std::string> files = options.libraries,
                             names(plugin.linked.names.begin(), plugin.linked.names.end());
    for (const auto& library : target.libraries) (library[0] == '/' ? files : names).push_back(library);
    for (const auto& [dir, library] : plugin.installed)
        for (const auto& file : library.libraries) files.push_back(file.string());
    return cmake_argument("LIBRARIES", files) + cmake_argument("LIBRARIES_IF_FOUND", names) +
           cmake_argument("LIBRARY_DIRS", absolute_names(target.library_dirs));
}

// A component with copies of a library's headers, for example of OpenCV 2, is compiled with those of the installed
// version, because the functions of the copies are not there.
std::string headers_first(const Plugin& plugin) {
    const auto& modules = plugin.linked.modules;
    if (modules.empty()) return "";
    return fmt::format("find_package(PkgConfig REQUIRED)\n"
                       "pkg_check_modules(LINKED QUIET {})\n"
                       "target_include_directories({} BEFORE PRIVATE ${{LINKED_INCLUDE_DIRS}})\n",
                       fmt::join(modules, " "), plugin.name);
}

} // namespace

std::set<std::string> used_modules(const Plugin& plugin) {
    auto modules = plugin.includes.pkg_config;
    modules.insert(plugin.linked.modules.begin(), plugin.linked.modules.end());
    for (const auto& [dir, library] : plugin.installed)
        if (!library.pkg_config.empty()) modules.insert(library.pkg_config);
    return modules;
}

std::vector<fs::path> include_dirs(const Plugin& plugin, const PluginBuildOptions& options) {
    std::vector<fs::path> dirs(options.include_dirs.begin(), options.include_dirs.end());
    const auto& of_project = plugin.sources.target.include_dirs;
    dirs.insert(dirs.end(), of_project.begin(), of_project.end());
    return dirs;
}

// Paths are absolute, because the CMakeLists.txt is in the build folder.
std::string cmake_project(const Plugin& plugin, const PluginBuildOptions& options, const fs::path& build,
                          const fs::path& forwards) {
    const auto modules = used_modules(plugin);
    // Definitions from the command line come last, because the compiler uses the last definition of a name.
    std::vector<std::string> definitions = plugin.definitions;
    definitions.insert(definitions.end(), options.definitions.begin(), options.definitions.end());
    const bool rtm = plugin.model == "rtm";
    return std::string("cmake_minimum_required(VERSION 3.16)\nproject(component ") +
           languages(plugin.sources.sources) + ")\nfind_package(Tandem REQUIRED COMPONENTS " + plugin.model +
           ")\n" + compile_options(plugin) + "set(CMAKE_LIBRARY_OUTPUT_DIRECTORY " +
           text::quote_cmake((build / "made").string()) + ")\ntandem_add_" + plugin.model + "_component(" +
           plugin.name + "\n  FOLDER " + text::quote_cmake(fs::absolute(options.folder).string()) +
           cmake_argument("CANDIDATES", absolute_names(plugin.sources.sources)) +
           (rtm ? cmake_argument("MORE_IDL", absolute_names(plugin.includes.idl_files)) : "") +
           cmake_argument("INCLUDE_DIRS", absolute_names(include_dirs(plugin, options))) +
           cmake_argument("DEFINITIONS", definitions) + libraries(plugin, options) +
           cmake_argument("PKG_CONFIG", options.pkg_config) +
           cmake_argument("PKG_CONFIG_IF_FOUND", {modules.begin(), modules.end()}) +
           cmake_argument("FORWARDS", {forwards.string()}) +
           fmt::format("\n  CXX_STANDARD {})\n", standard_of(plugin, options)) + headers_first(plugin);
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/cmake_project.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

std::string cmake_quote(const std::string& text) {
    // CMake expands nothing in a bracket argument.
    return "[==[" + text + "]==]";
}

// Returns a keyword of the CMake function with its values; "" without values.
std::string cmake_argument(const char* keyword, const std::vector<std::string>& values) {
    if (values.empty()) return "";
    std::string text = std::string("\n  ") + keyword;
    for (const auto& value : values) text += " " + cmake_quote(value);
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

} // namespace

// Paths are absolute, because the CMakeLists.txt is in the build folder.
std::string cmake_project(const Plugin& plugin, const PluginBuildOptions& options, const fs::path& build,
                          const fs::path& forwards) {
    const std::vector<fs::path> include_dirs(options.include_dirs.begin(), options.include_dirs.end());
    const std::vector<std::string> found_modules(plugin.includes.pkg_config.begin(),
                                                 plugin.includes.pkg_config.end());
    // Definitions from the command line come last, because the compiler uses the last definition of a name.
    std::vector<std::string> definitions = plugin.definitions;
    definitions.insert(definitions.end(), options.definitions.begin(), options.definitions.end());
    const bool rtm = plugin.model == "rtm"; // the CMake function of RTM skips programs
    return std::string("cmake_minimum_required(VERSION 3.16)\nproject(component ") +
           languages(plugin.sources.sources) + ")\nfind_package(Tandem REQUIRED COMPONENTS " + plugin.model +
           ")\n" +
           (plugin.needs_cv_h ? "add_compile_options(\"$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include cv.h "
                                "-include highgui.h>\")\n"
                              : "") +
           "set(CMAKE_LIBRARY_OUTPUT_DIRECTORY " + cmake_quote((build / "made").string()) + ")\ntandem_add_" +
           plugin.model + "_component(" + plugin.name + "\n  FOLDER " +
           cmake_quote(fs::absolute(options.folder).string()) +
           cmake_argument(rtm ? "CANDIDATES" : "SOURCES", absolute_names(plugin.sources.sources)) +
           (rtm ? cmake_argument("MORE_IDL", absolute_names(plugin.includes.idl_files)) : "") +
           cmake_argument("INCLUDE_DIRS", absolute_names(include_dirs)) +
           cmake_argument("DEFINITIONS", definitions) + cmake_argument("LIBRARIES", options.libraries) +
           cmake_argument("PKG_CONFIG", options.pkg_config) +
           cmake_argument("PKG_CONFIG_IF_FOUND", found_modules) +
           cmake_argument("FORWARDS", {forwards.string()}) +
           fmt::format("\n  CXX_STANDARD {})\n", options.standard);
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/plugin_build.hpp"

#include "apps/tandem/build/build_folder.hpp"
#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/project_files.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/missing_names.hpp"
#include "apps/tandem/build/packages/header_packages.hpp"
#include "apps/tandem/build/packages/installed_library.hpp"
#include "apps/tandem/build/packages/offer_package.hpp"
#include "apps/tandem/build/plain_path.hpp"
#include "apps/tandem/build/plugin_project.hpp"
#include "apps/tandem/build/project/cmake_package.hpp"
#include "apps/tandem/build/project/cmake_projects.hpp"
#include "apps/tandem/build/remedy.hpp"
#include "apps/tandem/build/replace_file.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "host/process/run_command.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> checkout_files(const fs::path& folder) {
    const auto checkout = find_checkout(folder);
    return checkout.empty() ? std::vector<fs::path>{} : list_files_below(checkout);
}

// Returns the advice to install a package whose headers were found in the repository instead, if one of these lacks a
// header: such a copy of a library is often one for Windows.
std::string package_of_neighbours(const NeighbourHeaders& neighbours, const std::string& error) {
    if (missing_header(error).empty()) return "";
    for (const auto& [header, file] : neighbours)
        if (const auto found = find_package_of_header(header);
            found && found->certain && error.starts_with(file.parent_path().string() + "/") &&
            installed_files(found->package).empty())
            return fmt::format("apt install {}: its {} replaces the one of this repository", found->package,
                               header);
    return "";
}

// Returns the advice that follows the first error of a failed step.
std::string advice(const std::string& error, const Plugin& plugin, const PluginBuildOptions& options) {
    const auto& folder = options.folder;
    BuildFacts facts{folder, options.pkg_config, options.libraries, "/", plugin.includes.unknown};
    for (const auto& module : used_modules(plugin)) facts.pkg_config.push_back(module);
    for (const auto& name : plugin.linked.names) facts.libraries.push_back(name);
    std::string text = find_remedy(error, facts);
    if (text.find("--source FILE") != std::string::npos) {
        // Files that were left out may define a function that no known library defines. --source replaces the sources
        // found: it must name these, too.
        const auto definitions = find_definitions(checkout_files(folder), undefined_symbol(error));
        if (definitions.size() == 1) {
            text = "another source file of this repository defines it: use";
            for (const auto& file : plugin.sources.sources) text += " --source " + file.filename().string();
            text += " --source " + definitions[0].lexically_proximate(fs::current_path()).string();
        } else if (!plugin.sources.left_out.empty()) {
            text =
                "these files were left out because " + plugin.sources.project_files + " does not list them:";
            for (const auto& file : plugin.sources.left_out) text += " " + file.filename().string();
            text += "; to build them, name all source files with --source";
        }
    }
    if (const auto name = dropped_by_opencv(error);
        (plugin.includes.old_opencv || plugin.needs_cv_h) && !name.empty())
        text = "OpenCV 4 no longer has " + name + ": use OpenCV's C++ API";
    if (auto package = package_of_neighbours(plugin.neighbours, error); !package.empty())
        text = std::move(package);
    return text;
}

// Runs one step of CMake. Returns its output if it failed.
std::optional<std::string> run_cmake(const std::vector<std::string>& command, double timeout_s,
                                     const std::string& name) {
    process::CommandOptions options;
    options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(timeout_s * 1000));
    options.merge_errors = true;
    options.stop_on_signal = true; // otherwise the build folder would be left behind
    process::CommandResult result;
    try {
        result = process::run_command(command, options);
    } catch (const std::system_error& error) {
        throw std::runtime_error(std::string(error.what()) + "; install it (apt install " + command[0] + ")");
    }
    if (result.stop_signal != 0)
        throw std::runtime_error("the build of component " + name + " " + result.failure());
    if (result.timed_out)
        throw std::runtime_error(fmt::format("the build of component {} did not finish within {} s and was "
                                             "stopped; allow more time with --timeout",
                                             name, timeout_s));
    if (result.succeeded()) return std::nullopt;
    return result.output;
}

/// A failed build that may succeed with a Debian package.
struct MissingPackage : std::runtime_error {
    MissingPackage(const std::string& message, std::string name)
        : std::runtime_error(message), package(std::move(name)) {}
    std::string package;
};

// Prints the output of a failed step. The exception repeats the first error with advice, so that it is the
// last line on the terminal.
[[noreturn]] void fail(const std::string& output, const Plugin& plugin, const PluginBuildOptions& options,
                       const std::string& what) {
    print_text(output);
    const std::string error = first_error(output_worded_as_gcc(output)),
                      remedy = advice(error, plugin, options);
    const auto message = "component " + plugin.name + " " + what + ": " + error +
                         (remedy.empty() ? "" : "; " + remedy) + " (the compiler's output is above" +
                         (plugin.problem.empty() ? "" : "; " + plugin.problem) + ")";
    if (auto package = package_to_install(remedy); !package.empty())
        throw MissingPackage(message, std::move(package));
    throw std::runtime_error(message);
}

// Returns the files of the checkout that give the header: copies of it, or else IDL files that it is made from.
std::vector<fs::path> find_origins(const std::string& header, const fs::path& folder) {
    const auto checkout = find_checkout(folder);
    auto found = find_in_checkout(checkout, header);
    if (const auto idl = idl_of_header(header); found.empty() && !idl.empty())
        found = find_in_checkout(checkout, (fs::path(header).parent_path() / idl).string());
    return found;
}

// Adds each missing header that exists, or whose IDL file does, in exactly one place of the checkout, and prints a
// note. Returns whether it added one.
bool add_neighbours(const std::string& output, const fs::path& folder, NeighbourHeaders& neighbours) {
    bool added = false;
    for (const auto& header : missing_headers(output)) {
        const auto found = find_origins(header, folder);
        if (found.size() != 1 || is_windows_header(header) || !neighbours.emplace(header, found[0]).second)
            continue;
        print_note("tandem: {} is not in {}; using the file found elsewhere in this repository: {}\n", header,
                   folder.string(), found[0].lexically_proximate(fs::current_path()).string());
        added = true;
    }
    return added;
}

// Adds the folders of installed libraries with missing headers, and prints notes. Returns whether it added one.
bool add_installed(const std::string& output, Plugin& plugin) {
    bool added = false;
    for (const auto& header : missing_headers(output)) {
        auto library = find_installed_library(header);
        if (!library) library = find_installed_beside(header, plugin.includes.unknown);
        if (!library || !plugin.installed.emplace(library->include_dir, *library).second) continue;
        print_note("tandem: using {} of {}{}\n", header, library->include_dir.string(),
                   library->package.empty() ? "" : ", package " + library->package);
        added = true;
    }
    return added;
}

// opencv2/opencv.hpp and others contained the C API in OpenCV 2 and 3, even where cv.h is included later. Returns
// whether including cv.h first may help, and prints a note.
bool add_cv_h(const std::string& output, Plugin& plugin) {
    const std::string name = dropped_by_opencv(first_error(output));
    if (name.empty() || plugin.includes.pkg_config.count("opencv4") == 0 || plugin.needs_cv_h) return false;
    plugin.needs_cv_h = true;
    print_note("tandem: {} is part of OpenCV's C API, which the OpenCV 4 headers included by {} omit; "
               "including cv.h and highgui.h before each source\n",
               name, plugin.name);
    return true;
}

// Adds declarations and standard headers that the sources lack. Returns whether it added one, and prints notes.
bool add_names(const std::string& output, std::map<std::string, std::string>& names) {
    bool added = false;
    for (const auto& [name, declaration] : missing_names(output)) {
        if (!names.emplace(name, declaration).second) continue;
        print_note("tandem: {} is missing; adding: {}\n", name, declaration);
        added = true;
    }
    return added;
}

// Adds the only one of the files that defines the symbol. Returns whether it did, and prints a note.
bool add_source(const std::vector<fs::path>& files, const std::string& symbol, Plugin& plugin) {
    const auto found = find_definitions(files, symbol);
    auto& sources = plugin.sources.sources;
    if (found.size() != 1 || std::find(sources.begin(), sources.end(), found[0]) != sources.end() ||
        defines_function(read_text(found[0]), plugin.entry_function))
        return false;
    require_cmake_path(found[0]);
    sources.push_back(found[0]);
    print_note("tandem: {} is undefined; also compiling {}\n", symbol,
               found[0].lexically_proximate(fs::current_path()).string());
    return true;
}

// Adds sources that define missing functions: those of the folder that its project file does not list, or else one
// of the checkout, whose search reads all files.
bool add_sources(const std::string& output, const PluginBuildOptions& options, Plugin& plugin) {
    if (!options.sources.sources.empty() || !options.sources.excluded.empty()) return false;
    const auto symbols = undefined_symbols(output);
    bool added = false;
    for (const auto& symbol : symbols) added |= add_source(plugin.sources.left_out, symbol, plugin);
    return added ||
           (!symbols.empty() && add_source(checkout_files(options.folder), *symbols.begin(), plugin));
}

// Returns the text of the header that is compiled before each source. C sources lack the headers of C++, whose names have
// no dot.
std::string declarations_of(const std::map<std::string, std::string>& names) {
    std::string text;
    for (const auto& [name, declaration] : names) {
        const bool of_cpp = name.front() == '<' && name.find('.') == std::string::npos;
        text += of_cpp ? "#ifdef __cplusplus\n" + declaration + "\n#endif\n" : declaration + "\n";
    }
    return text;
}

// Configures and compiles in the folder `build`. Repeats both when it has found what was missing.
void compile(Plugin& plugin, const PluginBuildOptions& options, const fs::path& build) {
    const std::string bin = (build / "bin").string();
    for (;;) {
        plugin.includes = scan_includes(options.folder, plugin.sources.sources, include_dirs(plugin, options),
                                        plugin.neighbours);
        for (const auto& idl : plugin.includes.idl_files) require_cmake_path(idl); // from any sub-folder
        const auto forwards = write_forwards(plugin.includes.forwards, build / "forwards");
        write_file(forwards / names_header, declarations_of(plugin.missing_names));
        write_file(build / "CMakeLists.txt", cmake_project(plugin, options, build, forwards));
        // Two steps, each with a separate time limit and message. CMAKE_HAVE_LIBC_PTHREAD saves CMake a
        // test program: glibc has threads in libc since 2.34.
        auto output =
            run_cmake({"cmake", "-S", build.string(), "-B", bin, "-DCMAKE_BUILD_TYPE=" + options.build_type,
                       "-DCMAKE_HAVE_LIBC_PTHREAD=ON", "-DTandem_DIR=" + cmake_package_folder().string()},
                      options.timeout_s, plugin.name);
        if (output) fail(*output, plugin, options, "cannot be configured");
        // Without a number, make would start one compiler per source.
        const auto processors = std::to_string(std::max(1U, std::thread::hardware_concurrency()));
        output =
            run_cmake({"cmake", "--build", bin, "--parallel", processors}, options.timeout_s, plugin.name);
        if (!output) return;
        const std::string errors = output_worded_as_gcc(*output);
        if (!add_neighbours(errors, options.folder, plugin.neighbours) && !add_installed(errors, plugin) &&
            !add_cv_h(errors, plugin) && !add_names(errors, plugin.missing_names) &&
            !add_sources(errors, options, plugin) && !add_libraries(errors, plugin.linked))
            fail(*output, plugin, options, "does not compile");
    }
}

// Checks the files and folders that the CMake functions for components find in the folder by themselves.
void require_plain_files(const fs::path& folder) {
    for (const char* place : {".", "src", "idl", "profile", "profiles"})
        for (const auto& file : list_files(folder / place))
            if (is_source(file) || file.extension() == ".idl" || is_xml(file)) require_cmake_path(file);
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder / "include", ignored))
        require_cmake_path(entry.path());
}

// Checks all names and options that reach CMake.
void require_plain_names(const PluginBuildOptions& options, const fs::path& output) {
    for (const auto& dir : options.include_dirs) require_cmake_path(dir);
    for (const auto& path : {options.folder, output, options.build}) require_cmake_path(path);
    require_plain_files(options.folder);
    for (const auto& library : options.libraries) require_library(library);
    for (const auto& module : options.pkg_config) require_pkg_config_module(module);
    for (const auto& definition : options.definitions) require_definition(definition);
}

// CMake configures each time. A second build in a kept folder compiles only changed files.
// Everything is made in the build folder; the output folder is touched only after the build has succeeded.
fs::path build_once(const std::string& model, const std::string& name, const EntryPoint& entry_point,
                    const PluginBuildOptions& options, const fs::path& default_folder,
                    CMakeProjects& projects) {
    const fs::path output =
        fs::absolute(options.output.empty() ? default_folder : options.output).lexically_normal();
    require_plain_names(options, output);
    Plugin plugin{model,
                  name,
                  entry_point.function,
                  select_sources(options.folder, entry_point, options.sources, {name, projects}),
                  {},
                  {},
                  {},
                  {},
                  {}};
    plugin.definitions = plugin.sources.target.sources.empty() ? read_definitions(options.folder)
                                                               : plugin.sources.target.definitions;
    plugin.problem = projects.problem();
    for (const auto& source : plugin.sources.sources) require_cmake_path(source);
    for (const auto& dir : plugin.sources.target.include_dirs) require_cmake_path(dir);
    const BuildFolder build(options.build);
    const fs::path cmake_output = build.path() / "made";
    compile(plugin, options, build.path());
    fs::create_directories(output);
    fs::path library = output / (name + ".so");
    tell_replaced(library);
    replace_library(cmake_output / library.filename(), library);
    // tandem_add_opros_component() copies the profiles beside the library: another folder needs them, too.
    if (!options.output.empty())
        for (const auto& entry : fs::directory_iterator(cmake_output))
            if (entry.path().filename() != library.filename()) {
                tell_replaced(output / entry.path().filename());
                fs::copy_file(entry.path(), output / entry.path().filename(),
                              fs::copy_options::overwrite_existing);
            }
    return library;
}

} // namespace

void require_folder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw std::runtime_error(folder.string() +
                                 " is not a folder: give the folder with the component's sources");
}

fs::path build_plugin(const std::string& model, const std::string& name, const EntryPoint& entry_point,
                      const PluginBuildOptions& options, const fs::path& default_folder,
                      CMakeProjects& projects) {
    for (const auto& dir : options.include_dirs) require_folder(dir);
    try {
        return build_once(model, name, entry_point, options, default_folder, projects);
    } catch (const MissingPackage& missing) {
        if (!offer_package(missing.package)) throw;
    }
    projects.forget(); // they may now find the package
    return build_plugin(model, name, entry_point, options, default_folder, projects);
}

} // namespace tandem::command

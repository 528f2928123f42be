// SPDX-License-Identifier: Apache-2.0
// Builds a component from its folder: writes a CMake project of one line for it, and has CMake do the work.
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/package_path.hpp"
#include "apps/tandem/opros/run_program.hpp"
#include "apps/tandem/text.hpp"
#include "host/opros/src/profile.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// Removed at the end, unless the user has named it.
class BuildFolder {
  public:
    explicit BuildFolder(const fs::path& wanted) : temporary_(wanted.empty()) {
        if (temporary_) {
            std::string name = (fs::temp_directory_path() / "tandem-build-XXXXXX").string();
            if (!mkdtemp(name.data()))
                throw std::runtime_error("no temporary folder " + name + " can be made");
            path_ = name;
        } else {
            fs::create_directories(wanted);
            path_ = fs::absolute(wanted);
        }
    }
    ~BuildFolder() {
        std::error_code ignored;
        if (temporary_) fs::remove_all(path_, ignored);
    }
    BuildFolder(const BuildFolder&) = delete;
    BuildFolder& operator=(const BuildFolder&) = delete;
    const fs::path& path() const { return path_; }

  private:
    bool temporary_;
    fs::path path_;
};

std::vector<engine::ComponentProfile> component_profiles(const fs::path& folder) {
    std::vector<engine::ComponentProfile> found;
    for (const char* place : {"", "profile", "profiles"}) {
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder / place, ignored)) {
            if (entry.path().extension() != ".xml") continue;
            try {
                found.push_back(engine::read_component_profile(entry.path()));
            } catch (const engine::SetupError&) {
                continue; // of a service, a data type, an application
            }
        }
    }
    return found;
}

engine::ComponentProfile the_profile(const BuildOptions& options) {
    if (!options.profile.empty()) return engine::read_component_profile(options.folder / options.profile);
    const auto all = component_profiles(options.folder);
    if (all.size() == 1) return all.front();
    if (all.empty())
        throw std::runtime_error("no component profile (XML with <component_profile>) in " +
                                 options.folder.string() +
                                 " nor in its profile/; name one with --profile FILE");
    std::string names;
    for (const auto& each : all)
        names += (names.empty() ? "" : ", ") + each.place.file.lexically_relative(options.folder).string();
    throw std::runtime_error(options.folder.string() + " has several component profiles: " + names +
                             "; name one with --profile FILE");
}

// X.dll, libX.so -> X, under which the host finds it again.
std::string library_stem(const std::string& library_name) {
    return fs::path(plugin::library_file_names(fs::path(library_name).filename().string()).back())
        .stem()
        .stem()
        .string();
}

std::string quoted(const std::string& text) {
    // Bracket arguments are taken as they are.
    return "[==[" + text + "]==]";
}

std::string listed(const char* keyword, const std::vector<std::string>& values) {
    if (values.empty()) return "";
    std::string text = std::string("\n  ") + keyword;
    for (const auto& value : values) text += " " + quoted(value);
    return text;
}

std::string project_text(const std::string& name, const BuildOptions& options, const fs::path& output) {
    std::vector<std::string> include_dirs;
    for (const auto& dir : options.include_dirs) include_dirs.push_back(fs::absolute(dir).string());
    return "cmake_minimum_required(VERSION 3.16)\nproject(component C CXX)\n"
           "find_package(Tandem REQUIRED COMPONENTS opros)\n"
           "set(CMAKE_LIBRARY_OUTPUT_DIRECTORY " +
           quoted(output.string()) +
           ")\n"
           "tandem_add_opros_component(" +
           name + "\n  FOLDER " + quoted(fs::absolute(options.folder).string()) +
           listed("INCLUDE_DIRS", include_dirs) + listed("DEFINITIONS", options.definitions) +
           listed("LIBRARIES", options.libraries) + fmt::format("\n  CXX_STANDARD {})\n", options.standard);
}

void require_folder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw std::runtime_error(folder.string() +
                                 " is not a folder; name the one with the component's sources");
}

// What the compiler says belongs to the user, all of it; the first error is repeated in our own line.
void run(const std::vector<std::string>& command, const std::string& what) {
    const ProgramEnd end = run_program(command);
    if (end.exit_code == 0) return;
    print_text(end.output);
    throw std::runtime_error(what + ": " + first_error(end.output) + " (the compiler's output is above)");
}

} // namespace

int opros_build(const BuildOptions& options) {
    require_folder(options.folder);
    const auto profile = the_profile(options);
    const std::string name = library_stem(profile.library_name);
    const fs::path output =
        fs::absolute(options.output.empty() ? profile.place.file.parent_path() : options.output);
    for (const auto& dir : options.include_dirs) require_folder(dir);
    const BuildFolder build(options.build);
    // The library replaces the old one when it is whole: a running host may have that one mapped.
    const fs::path made = build.path() / "made";
    std::ofstream(build.path() / "CMakeLists.txt") << project_text(name, options, made);
    const std::string bin = (build.path() / "bin").string();
    run({"cmake", "-S", build.path().string(), "-B", bin, "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
         "-DTandem_DIR=" + package_folder().string()},
        "component " + name + " cannot be set up");
    run({"cmake", "--build", bin, "--parallel"}, "component " + name + " does not compile");
    fs::create_directories(output);
    const fs::path library = output / (name + ".so"), fresh = output / ("." + name + ".so.new");
    fs::copy_file(made / (name + ".so"), fresh, fs::copy_options::overwrite_existing);
    fs::rename(fresh, library);
    if (!options.output.empty())
        for (const auto& entry : fs::directory_iterator(made))
            if (entry.path().extension() == ".xml")
                fs::copy_file(entry.path(), output / entry.path().filename(),
                              fs::copy_options::overwrite_existing);
    print_text(library.string() + "\n");
    return 0;
}

} // namespace tandem::command

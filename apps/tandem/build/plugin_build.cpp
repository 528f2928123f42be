// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/plugin_build.hpp"
#include "apps/tandem/build/first_error.hpp"
#include "apps/tandem/build/package_folder.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/process/run_command.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// The folder in which CMake works: temporary and removed with this object, unless the user has named one.
class BuildFolder {
  public:
    explicit BuildFolder(const fs::path& wanted) : temporary_(wanted.empty()) {
        if (temporary_) {
            std::error_code error;
            std::string name = (fs::temp_directory_path(error) / "tandem-build-XXXXXX").string();
            if (error)
                throw std::runtime_error("TMPDIR does not name a folder to build in: " + error.message());
            if (!mkdtemp(name.data()))
                throw std::runtime_error("temporary folder " + name + " cannot be created");
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

std::string cmake_quote(const std::string& text) {
    // CMake expands nothing inside of a bracket argument.
    return "[==[" + text + "]==]";
}

// A keyword of the CMake function with its values; "" without values.
std::string cmake_argument(const char* keyword, const std::vector<std::string>& values) {
    if (values.empty()) return "";
    std::string text = std::string("\n  ") + keyword;
    for (const auto& value : values) text += " " + cmake_quote(value);
    return text;
}

// The CMakeLists.txt. Paths are absolute, because it lies in the build folder.
std::string cmake_project(const std::string& model, const std::string& name,
                          const PluginBuildOptions& options, const fs::path& output) {
    std::vector<std::string> include_dirs;
    for (const auto& dir : options.include_dirs) include_dirs.push_back(fs::absolute(dir).string());
    return "cmake_minimum_required(VERSION 3.16)\nproject(component C CXX)\n"
           "find_package(Tandem REQUIRED COMPONENTS " +
           model + ")\nset(CMAKE_LIBRARY_OUTPUT_DIRECTORY " + cmake_quote(output.string()) +
           ")\ntandem_add_" + model + "_component(" + name + "\n  FOLDER " +
           cmake_quote(fs::absolute(options.folder).string()) + cmake_argument("INCLUDE_DIRS", include_dirs) +
           cmake_argument("DEFINITIONS", options.definitions) +
           cmake_argument("LIBRARIES", options.libraries) +
           fmt::format("\n  CXX_STANDARD {})\n", options.standard);
}

// Runs one step of CMake. On failure all of its output is printed, and its first error is repeated in the
// exception, where it is the last line on the terminal.
void run_cmake(const std::vector<std::string>& command, double timeout_s, const std::string& name,
               const std::string& what) {
    process::CommandOptions options;
    options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(timeout_s * 1000));
    options.merge_errors = true;
    options.stop_on_signal = true; // or the folder of the build would be left behind
    process::CommandResult result;
    try {
        result = process::run_command(command, options);
    } catch (const std::system_error& error) {
        throw std::runtime_error(std::string(error.what()) + "; install it (apt install " + command[0] + ")");
    }
    if (result.stop_signal != 0)
        throw std::runtime_error("the build of component " + name + " " + result.failure());
    if (result.timed_out)
        throw std::runtime_error(fmt::format("the build of component {} was not done within {} s and has "
                                             "been ended; --timeout gives it more time",
                                             name, timeout_s));
    if (result.succeeded()) return;
    print_text(result.output);
    throw std::runtime_error("component " + name + " " + what + ": " + first_error(result.output) +
                             " (the compiler's output is above)");
}

// CMake separates the elements of a list by ';', and knows no way to quote it that survives every function.
void require_no_semicolon(const fs::path& path) {
    const std::string whole = path.empty() ? "" : fs::absolute(path).lexically_normal().string();
    if (whole.find(';') != std::string::npos)
        throw std::runtime_error(whole +
                                 " has a ';' in its name, at which CMake takes it apart; build in a folder "
                                 "without one");
}

// Replaces the library by rename(2), not by writing into it: a running host may have the old file mapped, and a
// copy that fails half-way must not leave half a library.
void replace_library(const fs::path& cmake_output, const fs::path& library) {
    const fs::path new_file = library.parent_path() / ("." + library.filename().string() + ".new");
    std::error_code error, ignored;
    if (fs::copy_file(cmake_output, new_file, fs::copy_options::overwrite_existing, error))
        fs::rename(new_file, library, error);
    if (!error) return;
    fs::remove(new_file, ignored);
    throw std::runtime_error(library.string() + " cannot be written: " + error.message());
}

} // namespace

void add_build_options(CLI::App* command, PluginBuildOptions& options, const char* output_help) {
    const auto repeated = [&](const char* flag, std::vector<std::string>& values, const char* what) {
        return command->add_option(flag, values, what)->allow_extra_args(false);
    };
    command->add_option("DIR", options.folder, "folder of the component")->required();
    repeated("-I,--include", options.include_dirs, "folder with headers of other components (repeatable)")
        ->type_name("DIR");
    repeated("-D,--define", options.definitions, "preprocessor definition (repeatable)");
    repeated("-l,--library", options.libraries, "library to link: a name or a file (repeatable)");
    command->add_option("--standard", options.standard, "C++ standard (14)")
        ->check(CLI::IsMember({11, 14, 17, 20}));
    command
        ->add_option("--timeout", options.timeout_s,
                     "time limit for each step, configuration and compilation (600)")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 86400.));
    command->add_option("--output", options.output, output_help)->type_name("DIR");
    command->add_option("--build-dir", options.build, "build folder to keep and use again (a temporary one)")
        ->type_name("DIR");
}

void require_folder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw std::runtime_error(folder.string() +
                                 " is not a folder; name the one with the component's sources");
}

// CMake configures anew each time: a second build in a kept folder compiles only what has changed.
// Everything is made in the build folder; the output folder is touched only after the build has succeeded.
fs::path build_plugin(const std::string& model, const std::string& name, const PluginBuildOptions& options,
                      const fs::path& default_folder) {
    for (const auto& dir : options.include_dirs) require_folder(dir);
    const fs::path output =
        fs::absolute(options.output.empty() ? default_folder : options.output).lexically_normal();
    for (const auto& dir : options.include_dirs) require_no_semicolon(dir);
    for (const auto& dir : {options.folder, output, options.build}) require_no_semicolon(dir);
    const BuildFolder build(options.build);
    const fs::path cmake_output = build.path() / "made";
    std::ofstream(build.path() / "CMakeLists.txt") << cmake_project(model, name, options, cmake_output);
    const std::string bin = (build.path() / "bin").string();
    run_cmake({"cmake", "-S", build.path().string(), "-B", bin, "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
               "-DTandem_DIR=" + cmake_package_folder().string()},
              options.timeout_s, name, "cannot be set up");
    // Two steps, each with its own time limit and its own message.
    run_cmake({"cmake", "--build", bin, "--parallel"}, options.timeout_s, name, "does not compile");
    fs::create_directories(output);
    fs::path library = output / (name + ".so");
    replace_library(cmake_output / library.filename(), library);
    // tandem_add_opros_component() copies the profiles beside the library: another folder needs them, too.
    if (!options.output.empty())
        for (const auto& entry : fs::directory_iterator(cmake_output))
            if (entry.path().filename() != library.filename())
                fs::copy_file(entry.path(), output / entry.path().filename(),
                              fs::copy_options::overwrite_existing);
    return library;
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
// A temporary folder with the test components, each in a separate folder, as users have them.
#pragma once

#include "host/process/run_command.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "tandem-join-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// A folder NAME with NAME.so, and NAME.xml if there is one.
    void add_component(const std::string& name) const {
        namespace fs = std::filesystem;
        fs::create_directory(path_ / name);
        fs::copy_file(fs::path(TEST_PLUGINS) / (name + ".so"), path_ / name / (name + ".so"));
        const fs::path profile = fs::path(TEST_SOURCES "/opros") / (name + ".xml");
        if (fs::exists(profile)) fs::copy_file(profile, path_ / name / (name + ".xml"));
    }
    /// Runs `tandem` in the folder; its standard error follows its output in the result.
    tandem::process::CommandResult tandem(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), TANDEM_PROGRAM);
        tandem::process::CommandOptions options;
        options.folder = path_.string();
        options.merge_errors = true;
        return tandem::process::run_command(arguments, options);
    }

  private:
    std::filesystem::path path_;
};

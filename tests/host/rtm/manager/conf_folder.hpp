// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace testing {

/// A temporary folder with an rtc.conf.
struct ConfFolder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tandem_rtm." + std::to_string(getpid()));
    explicit ConfFolder(const std::string& name = "") {
        if (!name.empty()) path += "." + name;
        std::filesystem::create_directories(path);
    }
    ~ConfFolder() { std::filesystem::remove_all(path); }
    std::string conf(const std::string& text) const {
        std::ofstream(path / "rtc.conf") << "manager.modules.load_path: " TANDEM_TEST_PLUGINS "\n" << text;
        return (path / "rtc.conf").string();
    }
};

} // namespace testing

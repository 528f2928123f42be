// SPDX-License-Identifier: Apache-2.0
// RTC::ManagerConfig, with which programs read rtc.conf without a manager.
#include "tests/host/rtm/manager_fixture.hpp"

#include <filesystem>
#include <fstream>
#include <rtm/ManagerConfig.h>

TEST_CASE("ManagerConfig reads the settings that a manager reads from the same command line") {
    const auto file = std::filesystem::temp_directory_path() / ("tandem_config." + std::to_string(getpid()));
    std::ofstream(file) << "exec_cxt.periodic.rate: 50\nnaming.formats: %n.rtc\n";
    std::string words[] = {"program", "-f", file.string(), "-o", "naming.formats:%i.rtc"};
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    RTC::ManagerConfig config(static_cast<int>(arguments.size()), arguments.data());
    coil::Properties settings;
    config.configure(settings);
    std::filesystem::remove(file);
    CHECK(settings.getProperty("exec_cxt.periodic.rate") == "50");
    CHECK(settings.getProperty("naming.formats") == "%i.rtc"); // the command line wins
    CHECK(settings.getProperty("manager.instance_name") == "manager");
    CHECK(settings.getProperty("config_file") == file.string());
    CHECK(settings.getProperty("os.name") == "Linux");
}

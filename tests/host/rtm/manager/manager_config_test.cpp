// SPDX-License-Identifier: Apache-2.0
// RTC::ManagerConfig, with which programs read rtc.conf without a manager, and the settings of managers in other processes.
#include "host/rtm/runtime/configuration/manager_settings.hpp"
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

namespace {

/// The files that another process sees, in a folder of this test.
struct OtherProcess {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("tandem_manager." + std::to_string(getpid()));
    RTC::ManagerStart start{{"rtm_host"}, {}, [this](const std::string& file) {
                                const bool is_absolute = std::filesystem::path(file).is_absolute();
                                return folder / (is_absolute ? file.substr(1) : "cwd/" + file);
                            }};
    ~OtherProcess() { std::filesystem::remove_all(folder); }
    /// Makes a file whose setting is its own name.
    void make(const std::string& file) {
        std::filesystem::create_directories(start.path_of(file).parent_path());
        std::ofstream(start.path_of(file)) << "naming.formats: " << file << "\n";
    }
    std::string read_setting() {
        coil::Properties settings;
        RTC::SettingOrigins origins;
        const std::string file = RTC::read_manager_settings(start, settings, origins);
        CHECK(settings.getProperty("config_file") == file);
        return settings.getProperty("naming.formats");
    }
};

} // namespace

TEST_CASE(
    "A manager without -f reads the first of $RTC_MANAGER_CONFIG and three places, in its own process") {
    OtherProcess process;
    CHECK(process.read_setting().empty());
    for (const std::string file : {"/etc/rtc/rtc.conf", "/etc/rtc.conf", "./rtc.conf"}) {
        process.make(file);
        CHECK(process.read_setting() == file);
    }
    process.make("named.conf");
    process.start.conf_variable = "named.conf";
    CHECK(process.read_setting() == "named.conf");
    process.make("given.conf");
    process.start.arguments = {"rtm_host", "-f", "given.conf"};
    CHECK(process.read_setting() == "given.conf");
    process.start.arguments.insert(process.start.arguments.end(), {"-o", "naming.formats=option"});
    CHECK(process.read_setting() == "option");
    process.start.arguments = {"rtm_host", "-f", "absent.conf"};
    CHECK_THROWS_AS(process.read_setting(), RTC::ManagerError);
    process.start.arguments.push_back("-i");
    CHECK(process.read_setting().empty());
}

// SPDX-License-Identifier: Apache-2.0
// What `tandem doctor` says about the settings of a running rtm_host.
#include "tests/apps/tandem/program.hpp"
#include "tests/host/rtm/host_process.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>

using namespace tandem::test;

namespace {

/// An rtc.conf that permits a user, named by $RTC_MANAGER_CONFIG of programs that this test starts.
struct NamedConf {
    NamedConf() : file(std::filesystem::temp_directory_path() / ("doctor-conf-" + std::to_string(getpid()))) {
        std::ofstream(file) << "corba.permitted_users: root\n";
        setenv("RTC_MANAGER_CONFIG", file.c_str(), 1);
    }
    ~NamedConf() {
        unsetenv("RTC_MANAGER_CONFIG");
        std::filesystem::remove(file);
    }
    const std::filesystem::path file;
};

/// Starts a host with these arguments, and returns what the doctor says about its permitted users; "": nothing.
std::string permitted_users_of_host(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-p", testing::unused_port(), "-o", "manager.shutdown_auto:NO"});
    testing::HostProcess host(arguments);
    REQUIRE(host.wait_for_output("ready"));
    const std::string name = "rtm_host (pid " + std::to_string(host.pid()) + ")";
    const auto checks = tandem_program({"doctor", "--json"}).json()["checks"];
    std::string users;
    bool is_shown = false;
    for (const auto& check : checks) {
        is_shown = is_shown || check["name"] == name + ": TCP";
        if (check["name"] == name + ": corba.permitted_users") users = check["value"];
    }
    CHECK(is_shown);
    return users;
}

} // namespace

TEST_CASE("tandem doctor reads the settings of a running host from where the host has read them") {
    CHECK(permitted_users_of_host({"-f", "/dev/null"}).empty());
    CHECK(permitted_users_of_host({"-f", "/dev/null", "-o", "corba.permitted_users:root"}) == "root");
    CHECK(permitted_users_of_host({"-f", "/dev/null", "-o", "corba.permitted_users=root"}) == "root");
    const NamedConf conf;
    CHECK(permitted_users_of_host({}) == "root");
    CHECK(permitted_users_of_host({"-f", "/dev/null"}).empty());
}

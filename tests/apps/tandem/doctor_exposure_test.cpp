// SPDX-License-Identifier: Apache-2.0
// The results of `tandem doctor` about things that are open to other users and machines, on file trees of the
// test.
#include "apps/tandem/doctor/exposure.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

using namespace tandem::doctor;
namespace fs = std::filesystem;

namespace {

/// A machine made of files in a temporary folder. Processes of this user own everything on it.
class FakeMachine {
  public:
    FakeMachine() {
        std::string name = (fs::temp_directory_path() / "tandem-doctor-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        machine.root = name;
        machine.probed.user = geteuid();
        fs::create_directories(machine.path("/dev/shm"));
        file("/proc/net/tcp", tcp_headings);
        file("/proc/net/tcp6", tcp_headings);
    }
    ~FakeMachine() { fs::remove_all(machine.root); }
    FakeMachine(const FakeMachine&) = delete;
    FakeMachine& operator=(const FakeMachine&) = delete;

    void file(const std::string& name, const std::string& content, mode_t mode = 0644) {
        const fs::path path = machine.path(name);
        fs::create_directories(path.parent_path());
        std::ofstream(path, std::ios::app) << content;
        REQUIRE(chmod(path.c_str(), mode) == 0);
    }
    void folder(const std::string& name, mode_t mode) {
        fs::create_directories(machine.path(name));
        REQUIRE(chmod(machine.path(name).c_str(), mode) == 0);
    }
    /// A process that listens at an address as in /proc/net/tcp, or tcp6 for one of 32 digits.
    void process(int pid, const std::string& command, const std::vector<std::string>& arguments,
                 const std::string& address) {
        const std::string proc = "/proc/" + std::to_string(pid);
        file(proc + "/comm", command + "\n");
        std::string line;
        for (const auto& argument : arguments) line += argument + '\0';
        file(proc + "/cmdline", line);
        fs::create_directories(machine.path(proc + "/fd"));
        const std::string inode = std::to_string(1000 + pid);
        fs::create_symlink("socket:[" + inode + "]", machine.path(proc + "/fd/5"));
        file(address.size() > 16 ? "/proc/net/tcp6" : "/proc/net/tcp",
             "   0: " + address + " 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 " +
                 inode + " 1\n");
    }
    std::vector<CheckResult> run(const ReadSettings& read_settings = [](const RTC::ManagerStart&) {
        return RtmSettings();
    }) const {
        return check_running_programs(machine, read_settings);
    }

    static constexpr const char* tcp_headings =
        "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n";
    Machine machine;
};

const CheckResult* find(const std::vector<CheckResult>& results, const std::string& name) {
    const auto found =
        std::find_if(results.begin(), results.end(), [&](const auto& result) { return result.name == name; });
    return found == results.end() ? nullptr : &*found;
}

/// Checks a result: its status, a part of its value, and that it has advice, in one line, exactly if it is not ok.
void check(const std::vector<CheckResult>& results, const std::string& name, CheckStatus status,
           const std::string& value) {
    INFO(name);
    const CheckResult* const result = find(results, name);
    REQUIRE(result != nullptr);
    INFO(result->value << " - " << result->advice);
    CHECK(result->status == status);
    CHECK(result->value.find(value) != std::string::npos);
    CHECK(result->advice.empty() == (status == CheckStatus::ok));
    CHECK(result->advice.find('\n') == std::string::npos);
}

std::vector<std::string> addresses(const RtmSettings& settings) {
    std::vector<std::string> list;
    for (const auto& endpoint : configured_endpoints(settings))
        list.push_back((endpoint.is_for_machines ? "machines " : "here ") + endpoint.address);
    return list;
}

} // namespace

TEST_CASE("the endpoints of rtc.conf are those that rtm_host opens") {
    using List = std::vector<std::string>;
    CHECK(addresses({}).empty());
    CHECK(addresses({{"corba.endpoints", "127.0.0.1:2810, [::1]:2811,localhost"}}) ==
          List{"here 127.0.0.1:2810", "here [::1]:2811", "here localhost"});
    CHECK(addresses({{"corba.endpoints", "all, 10.0.0.7:, giop:ssl:robot:9"}}) ==
          List{"machines every address", "machines 10.0.0.7", "machines robot:9"});
    CHECK(addresses({{"corba.endpoints", "all"}, {"corba.endpoint", ":7"}}) ==
          List{"machines every address:7"});
    CHECK(addresses({{"corba.endpoints", "giop:unix:/run/x"}}).empty());
    CHECK(addresses({{"corba.nameservers", "robot"}}) == List{"here 127.0.0.1"});
    CHECK(addresses({{"corba.nameservers", "robot"}, {"naming.enable", "no"}}).empty());
    CHECK(addresses({{"manager.is_master", "yes"}}) == List{"here 127.0.0.1:2810"});
    CHECK(addresses(
              {{"manager.is_master", "YES"}, {"corba.endpoints", "all"}, {"corba.master_manager", "h:99"}}) ==
          List{"machines every address", "machines every address:99"});
}

TEST_CASE(
    "an endpoint for other machines is a warning without TLS, and each setting that opens more is one") {
    const std::vector<TcpEndpoint> here{{"127.0.0.1:2810", false}}, open{{"10.0.0.7:2810", true}};
    check(check_rtm_host("host", {}, {}), "host: TCP", CheckStatus::ok, "none");
    check(check_rtm_host("host", {}, here), "host: TCP", CheckStatus::ok, "this machine only");
    check(check_rtm_host("host", {}, open), "host: TCP", CheckStatus::warning, "every machine");
    RtmSettings settings{{"corba.ssl.certificate_authority_file", "a.pem"}, {"corba.ssl.key_file", "k.pem"}};
    check(check_rtm_host("host", settings, open), "host: TCP", CheckStatus::ok, "TLS");
    settings = {{"corba.permitted_users", "alice"},
                {"manager.modules.remote_load", "yes"},
                {"manager.remote_shutdown", "YES"}};
    const auto results = check_rtm_host("host", settings, open);
    check(results, "host: corba.permitted_users", CheckStatus::warning, "alice");
    check(results, "host: manager.modules.remote_load", CheckStatus::warning, "yes");
    check(results, "host: manager.remote_shutdown", CheckStatus::warning, "YES");
    CHECK(find(check_rtm_host("host", settings, here), "host: manager.remote_shutdown") == nullptr);
    CHECK(check_rtm_host("host", settings, {}).size() == 1);
}

TEST_CASE_METHOD(FakeMachine,
                 "a running rtm_host is shown with its sockets, and its settings by how it was started") {
    const std::vector<std::string> arguments{"rtm_host", "-o", "manager.remote_shutdown=YES"};
    process(12, "rtm_host", arguments, "0700000A:0AFA");
    file("/proc/12/environ", std::string("HOME=/\0RTC_MANAGER_CONFIG=robot.conf\0LANG=C\0", 44));
    int hosts = 0;
    const auto results = run([&](const RTC::ManagerStart& host) {
        ++hosts;
        CHECK(host.arguments == arguments);
        CHECK(host.conf_variable == "robot.conf");
        CHECK(host.path_of("robot.conf") == machine.path("/proc/12/cwd/robot.conf"));
        CHECK(host.path_of("/etc/rtc.conf") == machine.path("/etc/rtc.conf"));
        return RtmSettings{{"corba.permitted_users", "alice"}, {"manager.remote_shutdown", "YES"}};
    });
    CHECK(hosts == 1);
    check(results, "rtm_host (pid 12): TCP", CheckStatus::warning, "10.0.0.7:2810");
    check(results, "rtm_host (pid 12): corba.permitted_users", CheckStatus::warning, "alice");
    check(results, "rtm_host (pid 12): manager.remote_shutdown", CheckStatus::warning, "YES");
}

TEST_CASE_METHOD(FakeMachine, "an rtc.conf of a running host that cannot be read is a warning") {
    process(12, "rtm_host", {"rtm_host", "-f", "/etc/rtc.conf"}, "0100007F:0AFA");
    const auto results = run([](const RTC::ManagerStart& host) -> RtmSettings {
        CHECK_FALSE(host.conf_variable);
        throw std::runtime_error("no such\nfile");
    });
    check(results, "rtm_host (pid 12): TCP", CheckStatus::ok, "127.0.0.1:2810");
    check(results, "rtm_host (pid 12): settings", CheckStatus::warning, "unknown");
}

TEST_CASE_METHOD(FakeMachine, "a running monitor is shown with its address and whether it allows control") {
    process(20, "tandem", {"tandem", "monitor"}, "0100007F:1F90");
    process(21, "tandem", {"tandem", "monitor", "--bind", "::", "--control"},
            "00000000000000000000000000000000:1F91");
    process(22, "tandem", {"tandem", "top"}, "0100007F:1F92");
    const auto results = run();
    CHECK(results.size() == 2);
    check(results, "tandem monitor (pid 20)", CheckStatus::ok, "127.0.0.1:8080, every user");
    check(results, "tandem monitor (pid 21)", CheckStatus::warning, "[::]:8081, every machine");
    check(results, "tandem monitor (pid 21)", CheckStatus::warning, "control with the token");
}

TEST_CASE_METHOD(FakeMachine, "a CORBA server of another kind is a warning even at a loopback address") {
    process(30, "rtcd2", {"rtcd2"}, "0100007F:0AFB");
    process(31, "python3", {"python3"}, "00000000:1F40"); // no CORBA
    file("/proc/30/maps", "7f00 r-xp 00000000 00:00 0 /usr/lib/libomniORB4.so.2\n");
    const auto results = run();
    CHECK(results.size() == 1);
    check(results, "rtcd2 (pid 30)", CheckStatus::warning, "every user");
}

TEST_CASE_METHOD(FakeMachine,
                 "processes of other users are not shown, and without any open port one line says so") {
    process(12, "rtm_host", {"rtm_host"}, "00000000:0AFA");
    CHECK(run().size() == 1);
    ++machine.probed.user;
    check(run(), "open TCP ports", CheckStatus::ok, "none");
}

TEST_CASE_METHOD(FakeMachine,
                 "a segment that the group can open is a warning, and one that everybody can an error") {
    const std::string name = "access to segments";
    check({check_segment_modes(machine)}, name, CheckStatus::ok, "no segment");
    file("/dev/shm/tandem.chair.1", "", 0600);
    file("/dev/shm/other", "", 0666);
    check({check_segment_modes(machine)}, name, CheckStatus::ok, "1 of this user");
    file("/dev/shm/tandem.arm.1", "", 0660);
    check({check_segment_modes(machine)}, name, CheckStatus::warning, "tandem.arm.1 (mode 0660");
    file("/dev/shm/tandem.leg.1", "", 0604);
    check({check_segment_modes(machine)}, name, CheckStatus::error, "tandem.leg.1 (mode 0604");
    ++machine.probed.user;
    check({check_segment_modes(machine)}, name, CheckStatus::ok, "no segment");
}

TEST_CASE_METHOD(FakeMachine, "a runtime folder that others can enter or own is a warning") {
    const std::string name = "runtime folder";
    check({check_runtime_folder(machine)}, name, CheckStatus::ok, "does not exist");
    machine.probed.runtime_dir = "/run/mine";
    folder("/run/mine/tandem", 0700);
    folder("/run/mine", 0700);
    check({check_runtime_folder(machine)}, name, CheckStatus::ok, "/run/mine");
    folder("/run/mine/tandem", 0755);
    check({check_runtime_folder(machine)}, name, CheckStatus::warning, "/run/mine/tandem has mode 0755");
    folder("/run/mine/tandem", 0700);
    ++machine.probed.user;
    check({check_runtime_folder(machine)}, name, CheckStatus::warning, "belongs to");
    machine.probed.runtime_dir = "run";
    check({check_runtime_folder(machine)}, name, CheckStatus::warning, "run");
}

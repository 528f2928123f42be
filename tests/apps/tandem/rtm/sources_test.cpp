// SPDX-License-Identifier: Apache-2.0
// Where the sub-commands of `tandem rtm` look for components: managers and name servers.
#include "host/local/local_endpoint.hpp"
#include "tests/apps/tandem/rtm/running_manager.hpp"
#include "tests/support/skip.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

using tandem::test::Result;
using tandem::test::tandem_program;
using Running = tandem::test::RunningManager;

namespace {

/// Accepts connections and sends nothing, or, if requested, bytes that no GIOP server sends.
class WrongServer {
  public:
    explicit WrongServer(std::string answer) : answer_(std::move(answer)) {
        fd_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (bind(fd_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(fd_, 8) != 0)
            throw std::runtime_error("no server");
        getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size);
        at = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
        thread_ = std::thread([this] { serve(); });
    }
    ~WrongServer() {
        shutdown(fd_, SHUT_RDWR);
        thread_.join();
        close(fd_);
    }
    std::string at;

  private:
    void serve() {
        std::vector<int> taken;
        for (int fd; (fd = accept(fd_, nullptr, nullptr)) >= 0;) {
            taken.push_back(fd);
            if (!answer_.empty()) send(fd, answer_.data(), answer_.size(), MSG_NOSIGNAL);
        }
        for (const int fd : taken) close(fd);
    }
    std::string answer_;
    int fd_ = -1;
    std::thread thread_;
};

} // namespace

TEST_CASE("tandem rtm list lists a component once that it finds at several addresses") {
    Running host;
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    const std::string port = host.other.port;
    const std::vector<std::string> twice{
        "rtm", "list", "--manager", "127.0.0.1:" + port, "--manager", "localhost:" + port};
    const Result text = tandem_program(twice);
    CHECK(text.output.find("Counter0") != std::string::npos);
    CHECK(text.output.find("rtcloc://localhost") == std::string::npos);
    auto as_json = twice;
    as_json.push_back("--json");
    const auto list = tandem_program(as_json).json();
    REQUIRE(list.size() == 3);
    CHECK(list[0]["addresses"] ==
          nlohmann::json({host.at + "Counter0", "rtcloc://localhost:" + port + "/Counter0"}));
}

TEST_CASE("tandem rtm list finds hosts that listen with sockets of IPv6") {
    // OpenRTM-aist's managers do, unless corba.endpoints says otherwise.
    std::ifstream addresses("/proc/net/if_inet6");
    if (addresses.peek() == std::ifstream::traits_type::eof()) TANDEM_SKIP("this machine has no IPv6");
    for (const char* address : {"[::1]:", "[::ffff:127.0.0.1]:"}) {
        const std::string port = testing::unused_port();
        auto arguments =
            testing::RemoteHost::arguments("Counter", port, {"corba.endpoints:" + (address + port)});
        arguments.erase(std::find(arguments.begin(), arguments.end(), "-p"),
                        arguments.end() - 4); // and its port
        testing::HostProcess host(arguments);
        REQUIRE(host.wait_for_output("ready\n"));
        for (const auto& endpoint : tandem::local::find_local_endpoints(
                 tandem::local::manager_endpoint)) // managers of OpenRTM-aist have no such socket
            if (endpoint.pid == host.pid()) std::filesystem::remove(endpoint.socket);
        const std::string shown = std::string(address) == "[::1]:" ? address : "127.0.0.1:";
        const Result result = tandem_program({"rtm", "list"});
        INFO(result.output << result.errors);
        CHECK(result.output_contains("rtcloc://" + shown + port + "/Counter0"));
    }
}

TEST_CASE("tandem rtm list and tree show the sources that answer and fail if a named one does not") {
    Running host;
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    for (const char* command : {"list", "tree"}) {
        const Result result = host.run({command, "--nameserver", "127.0.0.1:9"});
        CHECK(result.output_contains("Counter0"));
        CHECK(result.exit_code == 1);
        CHECK(result.errors == "tandem: name server 127.0.0.1:9: no process listens there\n");
    }
}

TEST_CASE("tandem rtm reports a dead, hanging or foreign server in one line and in time") {
    const std::string dead = "127.0.0.1:9";
    WrongServer stuck(""), web("HTTP/1.1 400 Bad Request\r\n\r\n"),
        incomplete(std::string("GIOP\1\2\1\1\100\0\0\0", 12));
    for (const auto& at : {dead, stuck.at, web.at, incomplete.at})
        for (std::vector<std::string> command :
             {std::vector<std::string>{"list", "--manager", at, "--nameserver", at},
              {"tree", "--manager", at, "--nameserver", at},
              {"info", "rtcloc://" + at + "/A0"},
              {"activate", "rtcname://" + at + "/a/A0.rtc"},
              {"exit", "rtcloc://" + at + "/A0"},
              {"connect", "rtcloc://" + at + "/A0:out", "rtcloc://" + at + "/B0:in"},
              {"cat", "rtcloc://" + at + "/A0:out"},
              {"inject", "rtcloc://" + at + "/A0:in", "1"}}) {
            command.insert(command.begin(), "rtm");
            command.insert(command.end(), {"--timeout", "0.3"});
            const Result result = tandem_program(command);
            INFO(command[1] << " " << at << ": " << result.output << result.errors);
            CHECK(result.exit_code == 1);
            CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
            CHECK_THAT(result.errors, Catch::Contains(at));
        }
}

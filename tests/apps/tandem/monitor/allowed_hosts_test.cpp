// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/allowed_hosts.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace tandem::monitor;

namespace {

bool allows(const std::string& host, const std::string& local, const std::vector<std::string>& more = {}) {
    INFO(host);
    return AllowedHosts(more).allows(host, boost::asio::ip::make_address(local));
}

} // namespace

TEST_CASE("this machine and the connection's own address are allowed hosts") {
    for (const char* host : {"localhost", "LOCALHOST:8080", "127.0.0.1:1", "[::1]:8080", "[::1]",
                             "192.168.1.5", "192.168.1.5:8080"})
        CHECK(allows(host, "192.168.1.5"));
    CHECK(allows("[fe80:0::1]:8080", "fe80::1"));
    CHECK(allows("192.168.1.5:8080", "::ffff:192.168.1.5"));
}

TEST_CASE("names that could lead here by DNS, other addresses and malformed hosts are not allowed") {
    for (const char* host : {"", ":", ":8080", "example.org", "example.org:8080", "localhost.example.org",
                             "localhost.", "192.168.1.6", "0.0.0.0:8080", "[::]", "[::1", "::1", "[::1]8080",
                             "127.0.0.1:80x", "127.0.0.1:80:80", "user@127.0.0.1", "127.1", "2130706433"})
        CHECK_FALSE(allows(host, "192.168.1.5"));
}

TEST_CASE("the option --allow-host allows a name or an address in any spelling") {
    const std::vector<std::string> more{"Robot.local", "[2001:db8::7]", "10.0.0.9"};
    for (const char* host : {"robot.local:8080", "ROBOT.LOCAL", "[2001:DB8:0::7]:80", "10.0.0.9:8080"})
        CHECK(allows(host, "192.168.1.5", more));
    CHECK_FALSE(allows("robot.local.example.org", "192.168.1.5", more));
}

TEST_CASE("the option --allow-host refuses an invalid name") {
    for (const char* text : {"", "http://robot", "robot:8080", "robot/x", "*", "a b", "[robot]:1"}) {
        INFO(text);
        CHECK_THROWS_WITH(AllowedHosts(std::vector<std::string>{text}),
                          Catch::Contains("--allow-host") && Catch::Contains("robot.local"));
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "host/rt/lock_step/step_client.hpp"
#include "host/rt/lock_step/step_server.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

using namespace std::chrono_literals;
using tandem::rt::StepClient;
using tandem::rt::StepServer;

namespace {
std::string socket_path() {
    static int count = 0;
    return std::filesystem::temp_directory_path() /
           ("tandem_step_" + std::to_string(getpid()) + "_" + std::to_string(count++));
}
} // namespace

TEST_CASE("step() returns after one cycle of the named component") {
    const auto path = socket_path();
    std::vector<std::string> stepped;
    StepServer server(path, [&](const std::string& name) { stepped.push_back(name); });
    StepClient client(path, 10s);
    client.step("HWComp");
    client.step("Control Comp");
    CHECK(stepped == std::vector<std::string>{"HWComp", "Control Comp"});
}

TEST_CASE("an exception of a cycle reaches the client as one line, and the server keeps serving") {
    const auto path = socket_path();
    StepServer server(path, [](const std::string& name) {
        if (name == "bad") throw std::runtime_error("no component\n'bad'");
    });
    StepClient client(path, 10s);
    CHECK_THROWS_WITH(client.step("bad"), "no component 'bad'");
    CHECK_NOTHROW(client.step("good"));
}

TEST_CASE("a client waits for a server that is not there yet") {
    const auto path = socket_path();
    std::atomic<int> steps{0};
    std::unique_ptr<StepServer> server;
    std::thread late([&] {
        std::this_thread::sleep_for(20ms);
        server = std::make_unique<StepServer>(path, [&](const std::string&) { ++steps; });
    });
    StepClient client(path, 30s);
    client.step("x");
    late.join();
    CHECK(steps == 1);
}

TEST_CASE("a client without a server fails after its timeout with a message that names the socket") {
    const auto path = socket_path();
    CHECK_THROWS_WITH(StepClient(path, 1ms), Catch::Contains(path));
}

TEST_CASE("a client whose server goes away gets an error, not a hang") {
    const auto path = socket_path();
    auto server = std::make_unique<StepServer>(path, [](const std::string&) {});
    StepClient client(path, 10s);
    client.step("x");
    server.reset();
    CHECK_THROWS_WITH(client.step("x"), Catch::Contains("gone"));
    CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("the socket is for its owner only, and a stale one is replaced") {
    const auto path = socket_path();
    {
        StepServer first(path, [](const std::string&) {});
    }
    StepServer server(path, [](const std::string&) {});
    struct stat info {};
    REQUIRE(::stat(path.c_str(), &info) == 0);
    CHECK((info.st_mode & 0777) == 0600);
    CHECK_THROWS_WITH(StepServer(path, [](const std::string&) {}),
                      Catch::Contains("another process listens"));
}

TEST_CASE("a path that is not a socket is left alone") {
    const auto path = socket_path();
    std::ofstream(path) << "text";
    CHECK_THROWS_AS(StepServer(path, [](const std::string&) {}), std::runtime_error);
    CHECK(std::filesystem::file_size(path) == 4);
    std::filesystem::remove(path);
}

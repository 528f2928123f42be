// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/apps/tandem/program.hpp"
#include "tests/host/rtm/remote_host.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace tandem::test {

/// A host, and `tandem rtm` with its manager as the only place to look.
struct RunningManager {
    explicit RunningManager(const std::string& components = "Counter,Reporter,Thrower",
                            const std::vector<std::string>& settings = {})
        : other(components, testing::unused_port(), settings) {}
    testing::RemoteHost other;
    std::string at = "rtcloc://127.0.0.1:" + other.port + "/";

    Result run(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "rtm");
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + other.port});
        return tandem_program(arguments);
    }
    Result good(const std::vector<std::string>& arguments) {
        const Result result = run(arguments);
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 0);
        return result;
    }
    std::string failed(const std::vector<std::string>& arguments) {
        const Result result = run(arguments);
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        return result.errors;
    }
};

} // namespace tandem::test

// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"

#include "host/process/run_command.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace tandem::test {

nlohmann::json Result::json() const { return nlohmann::json::parse(output); }

Result tandem_program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TANDEM_PROGRAM);
    auto result = process::run_command(arguments, {.timeout = std::chrono::minutes(10)});
    return {result.exit_code(), std::move(result.output), std::move(result.errors)};
}

Result shm_program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "shm");
    return tandem_program(std::move(arguments));
}

nlohmann::json listed(const std::string& link) {
    const auto result = shm_program({"list", "--json"});
    REQUIRE(result.exit_code == 0);
    const auto json = result.json();
    for (const auto& segment : json["segments"])
        if (segment["link"] == link) return segment;
    return nullptr;
}

} // namespace tandem::test

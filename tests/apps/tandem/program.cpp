// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"

#include <fcntl.h>
#include <nlohmann/json.hpp>

namespace tandem::test {

nlohmann::json Result::json() const { return nlohmann::json::parse(output); }

std::string content_of(std::FILE* file) {
    std::string text;
    std::rewind(file);
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text.push_back(static_cast<char>(c));
    std::fclose(file);
    return text;
}

Result tandem_program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TANDEM_PROGRAM);
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::FILE *out = std::tmpfile(), *err = std::tmpfile();
    REQUIRE(out != nullptr);
    REQUIRE(err != nullptr);
    shm::test::Child child([&] {
        dup2(fileno(out), 1);
        dup2(fileno(err), 2);
        execv(argv[0], argv.data());
        return 98;
    });
    const int code = child.wait();
    return {code, content_of(out), content_of(err)};
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

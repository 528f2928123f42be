// SPDX-License-Identifier: Apache-2.0
#include "host/options/number_check.hpp"
#include "host/options/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

namespace {

/// Returns what a program with commands prints on standard error.
std::string printed(std::vector<std::string> arguments) {
    CLI::App app{"A program", "tool"};
    app.failure_message(tandem::options::usage_error);
    app.require_subcommand(1);
    std::string folder;
    int port = 0;
    double duration = 0;
    CLI::App* run = app.add_subcommand("run", "Runs");
    run->add_option("DIR", folder, "a folder")->required();
    run->add_option("--port", port, "a port")->check(CLI::Range(0, 65535));
    CLI::App* record = app.add_subcommand("record", "Records");
    record->add_option("--duration", duration, "a time")->check(tandem::options::positive_number());
    record->add_option("--period", duration, "a time")->check(tandem::options::number_between(0.1, 86400.0));
    record->add_option("--rate", duration, "a rate")->check(tandem::options::nonnegative_number());
    auto* format = record->add_option_group("format")->require_option(0, 1);
    format->add_flag("--csv");
    format->add_flag("--json");
    std::reverse(arguments.begin(), arguments.end()); // the order in which CLI11 takes them
    std::ostringstream out, errors;
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& error) {
        CHECK(app.exit(error, out, errors) == error.get_exit_code());
    }
    return errors.str();
}

} // namespace

TEST_CASE("A usage error is reported in one line that names the command, what is wrong and where to look") {
    CHECK(printed({"run", "."}).empty());
    CHECK(printed({"run", "--help"}).empty());
    CHECK(printed({}) == "tool: a command is missing; see tool --help\n");
    CHECK(printed({"run"}) == "tool run: DIR is required; see tool run --help\n");
    CHECK(printed({"rum"}) == "tool: there is no command 'rum'; did you mean run?; see tool --help\n");
    CHECK(printed({"--verbose"}) == "tool: there is no option --verbose; see tool --help\n");
    CHECK(printed({"run", "--prot=3"}) ==
          "tool run: there is no option --prot; did you mean --port?; see tool run --help\n");
    CHECK_THAT(printed({"run", ".", "--port", "x"}), // CLI11 2.4 puts the range in brackets
               Catch::StartsWith("tool run: --port: Value x not in range ") &&
                   Catch::EndsWith("; see tool run --help\n"));
    CHECK(printed({"run", "a", "b"}) ==
          "tool run: The following argument was not expected: b; see tool run --help\n");
}

TEST_CASE("The limits of a number are short") {
    CHECK(printed({"record", "--duration", "-1"}) ==
          "tool record: --duration: Value -1 is not a positive number; see tool record --help\n");
    CHECK(printed({"record", "--period", "0"}) ==
          "tool record: --period: Value 0 not in range 0.1 to 86400; see tool record --help\n");
    CHECK(printed({"record", "--rate", "-1"}) ==
          "tool record: --rate: Value -1 is not 0 or a positive number; see tool record --help\n");
}

TEST_CASE("A number that is not finite, or has trailing text, is refused") {
    for (const char* option : {"--duration", "--period", "--rate"}) {
        CHECK(printed({"record", option, "1.5"}).empty());
        for (const char* value : {"nan", "-nan", "NAN", "inf", "1,5", "2s", "1e999"})
            CHECK_THAT(printed({"record", option, value}), Catch::Contains(std::string("Value ") + value));
    }
}

TEST_CASE("Options that exclude each other are not a missing command") {
    const std::string line = printed({"record", "--csv", "--json"});
    CHECK_THAT(line, !Catch::Contains("command is missing"));
    CHECK_THAT(line, Catch::Contains("--csv") && Catch::Contains("--json"));
}

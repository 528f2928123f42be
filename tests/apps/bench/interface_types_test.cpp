// SPDX-License-Identifier: Apache-2.0
// The comparison of interface types on its smallest run: what arrives, not how fast.
#include "host/process/run_command.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <set>

namespace {

namespace fs = std::filesystem;

auto measure(std::vector<std::string> arguments) {
    const std::string build = fs::path(BENCH_PROGRAM).parent_path().parent_path();
    arguments.insert(arguments.begin(), {"python3", "-B", INTERFACE_TYPES_PROGRAM, "--build", build});
    return tandem::process::run_command(arguments);
}

} // namespace

TEST_CASE("Messages of each size arrive over each interface type and across the bridge, none lost") {
    std::string name = (fs::temp_directory_path() / "interface-types-test-XXXXXX").string();
    const fs::path folder = mkdtemp(name.data());
    const std::string file = folder / "rows.csv";
    const auto result = measure({"--messages", "5", "--rounds", "1", "--output", file});
    INFO(result.output << result.errors);
    CHECK(result.exit_code() == 0);
    // The rows up to the times: engine, interface type, round, bytes, samples, lost.
    std::set<std::string> rows, expected;
    std::ifstream lines(file);
    std::string line;
    std::getline(lines, line);
    CHECK(line == "engine,interface_type,round,bytes,samples,lost,p50_us,p99_us");
    while (std::getline(lines, line)) {
        std::size_t end = 0;
        for (int comma = 0; comma < 6 && end != std::string::npos; ++comma) end = line.find(',', end + 1);
        rows.insert(line.substr(0, end));
    }
    for (const char* type :
         {"direct_read", "direct", "corba_cdr_read", "corba_cdr", "shared_memory", "data_service", "bridge"})
        for (const int bytes : {8, 64, 1024, 16384, 262144, 1048576, 6291456})
            expected.insert(fmt::format("Tandem,{},1,{},5,0", type, bytes));
    CHECK(rows == expected);
    fs::remove_all(folder);
}

TEST_CASE("The comparison of interface types refuses what it cannot measure in one line") {
    const auto unknown_type = measure({"--types", "corba"});
    CHECK(unknown_type.exit_code() == 2);
    CHECK_THAT(unknown_type.errors,
               Catch::Contains("interface type corba: expected some of direct_read, direct, corba_cdr_read"));
    const auto no_openrtm = measure({"--openrtm", "/nonexistent"});
    CHECK(no_openrtm.exit_code() == 1);
    CHECK(no_openrtm.errors ==
          "measure.py: /nonexistent has no OpenRTM-aist 2.x: expected bin/rtcd2 and bin/rtm2-config\n");
}

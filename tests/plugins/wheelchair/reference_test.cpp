// SPDX-License-Identifier: Apache-2.0
// Compares the simulated run with rows that the Python reference of docs/wheelchair.md printed (section 11).
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/rows.hpp"
#include "tests/support/comma_locale.hpp"

using namespace tandem::wheelchair;

namespace {

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    return fields;
}

std::vector<std::string> csv_lines(const Scenario& scenario) {
    std::vector<std::string> lines;
    std::istringstream in(csv_text(simulate(scenario)));
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Two drives that the named scenarios leave out: backwards in a curve, and along a side slope.
Scenario extra(const std::string& name) {
    Scenario s = find_scenario("recorded");
    s.name = name;
    if (name == "reverse_steering") {
        s.seconds = 6.0;
        s.stick = [](int n) {
            if (n < 50) return JoystickPosition{};
            return JoystickPosition{n < 400 ? 700.0 : -700.0, -1100, false};
        };
    } else {
        s.seconds = 8.0;
        s.stick = [](int n) { return JoystickPosition{0, n >= 50 && n < 600 ? 900.0 : 0.0, false}; };
        s.slope = {5.0, 2.0, 0.5, 90.0, true};
    }
    return s;
}

bool is_extra(const std::string& name) { return name == "reverse_steering" || name == "side_slope"; }

std::vector<double> column(const std::vector<Row>& rows, double Row::*member) {
    std::vector<double> out;
    for (const Row& r : rows) out.push_back(r.*member);
    return out;
}

double path_length(const std::vector<Row>& rows, std::size_t from) {
    double sum = 0.0;
    for (std::size_t i = from; i + 1 < rows.size(); ++i)
        sum += std::hypot(rows[i + 1].x - rows[i].x, rows[i + 1].y - rows[i].y);
    return sum;
}

/// FNV-1a, 64 bits.
std::uint64_t digest(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

} // namespace

TEST_CASE("every scenario has the same log, byte for byte, on every processor and distribution") {
    std::ifstream file(std::string(TEST_DATA_DIR) + "/digests.txt");
    int compared = 0;
    for (std::string name, expected; file >> name >> expected; ++compared) {
        INFO(name);
        CHECK(digest(csv_text(simulate(find_scenario(name)))) == std::stoull(expected, nullptr, 16));
    }
    CHECK(compared == 14);
}

TEST_CASE("every scenario reproduces the rows of the Python reference") {
    std::ifstream file(std::string(TEST_DATA_DIR) + "/reference_rows.csv");
    REQUIRE(file);
    std::map<std::string, std::vector<std::string>> runs;
    std::string line;
    std::getline(file, line);
    int compared = 0;
    while (std::getline(file, line)) {
        const auto expected = split(line);
        const std::string& name = expected[0];
        if (!runs.count(name)) runs[name] = csv_lines(is_extra(name) ? extra(name) : find_scenario(name));
        const auto actual = split(runs[name].at(1 + std::stoul(expected[1])));
        REQUIRE(actual.size() + 2 == expected.size());
        for (std::size_t i = 0; i < actual.size(); ++i) {
            INFO(name << " tick " << expected[1] << " column " << i);
            const double a = std::stod(expected[i + 2]), b = std::stod(actual[i]);
            CHECK(std::abs(a - b) <= 1e-6 * std::max(1.0, std::abs(a)));
        }
        ++compared;
    }
    CHECK(compared == 80);
    CHECK(runs.size() == 16);
}

TEST_CASE("there are the fourteen scenarios of docs/wheelchair.md and one for recorded sticks") {
    CHECK(scenarios().size() == 15);
    CHECK(scenarios().front().name == "step20");
    CHECK_THROWS_WITH(find_scenario("step21"), Catch::StartsWith("no scenario 'step21'; there are step20, "));
}

TEST_CASE("the chair stops within the distances of docs/wheelchair.md, section 8") {
    CHECK(path_length(simulate(find_scenario("stop_full")), 500) == Approx(1.57).margin(0.01));
    CHECK(path_length(simulate(find_scenario("stop_turning")), 500) == Approx(0.65).margin(0.01));
    CHECK(path_length(simulate(find_scenario("estop")), 500) == Approx(0.82).margin(0.02));
}

TEST_CASE("a reference that stays out for two seconds stops the chair until the stick is released") {
    const auto rows = simulate(find_scenario("stale"));
    for (std::size_t n = 0; n < rows.size(); ++n) {
        INFO("tick " << n);
        CHECK(rows[n].state == (n >= 505 && n < 883 ? 1 : 0));
    }
    CHECK(rows[800].wheel_left == Approx(0.0).margin(0.01));
    CHECK(rows.back().wheel_left > 1.0);
}

TEST_CASE("in reverse in a curve, the chair yaws like a car") {
    const auto rows = simulate(extra("reverse_steering"));
    CHECK(rows[390].steering_true_deg == Approx(12.0).margin(0.5));
    CHECK(rows[390].heading < rows[200].heading);
    CHECK(rows[600].steering_true_deg == Approx(-12.0).margin(0.5));
    CHECK(rows[600].heading > rows[500].heading);
}

TEST_CASE("a side slope does not turn the chair downhill for long") {
    const auto rows = simulate(extra("side_slope"));
    const auto heading = column(rows, &Row::heading);
    CHECK(std::abs(heading[600] - heading[400]) < 0.001);
    CHECK(std::abs(heading[600]) * degrees < 1.5);
}

TEST_CASE("numbers are written as %.7g, counts as whole numbers, and tiny magnitudes as 0") {
    Row row;
    row.t = 0.07;
    row.jx = -1100;
    row.reference_speed = -1e-13;
    row.x = 123456.789012;
    row.state = 3;
    const std::string line = "0.07,-1100,0,0,0,0,0,0,0,0,0,0,0,0,0,0,123456.8,0,0,0,0,0,3\n";
    const auto text = csv_text({row});
    CHECK(text.substr(text.find('\n') + 1) == line);
    const tandem::test::CommaLocale locale; // another component of the host may have set it
    CHECK(csv_text({row}) == text);
}

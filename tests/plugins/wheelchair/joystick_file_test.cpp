// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <fstream>

#include "plugins/wheelchair/core/record/joystick_file.hpp"
#include "plugins/wheelchair/core/record/rows.hpp"
#include "tests/apps/wheelchair/scratch_dir.hpp"

using namespace tandem::wheelchair;

namespace {

std::string complaint(const std::string& content) {
    const ScratchDir dir;
    const auto path = dir / "stick.csv";
    std::ofstream(path) << content;
    try {
        read_joystick_file(path);
    } catch (const InputError& e) {
        const std::string text = e.what();
        CHECK(text.find('\n') == text.npos);
        return text.substr(path.string().size());
    }
    return "accepted";
}

} // namespace

TEST_CASE("a recorded stick position holds until the next one") {
    const ScratchDir dir;
    const auto path = dir / "stick.csv";
    std::ofstream(path) << "t,jx,jy,estop\n# a comment\n0.5, 0, 900, 0\r\n\n5.00,1100,900,0\n10,0,0,1\n";
    const auto stick = read_joystick_file(path);
    CHECK(stick.at(0.49).y == 0);
    CHECK(stick.at(0.50).y == 900);
    CHECK(stick.at(4.99).x == 0);
    CHECK(stick.at(500 * 0.01).x == 1100);
    CHECK(stick.at(10.0).emergency_stop);
    CHECK(stick.seconds() == 10.0);
}

TEST_CASE("a recording of step20's stick drives as step20 does") {
    const ScratchDir dir;
    const auto path = dir / "stick.csv";
    std::ofstream(path) << "0.5,0,900,0\n5,1100,900,0\n10,1100,900,0\n";
    CHECK(csv_text(simulate(load_scenario("step20", path))) == csv_text(simulate(find_scenario("step20"))));
    CHECK(load_scenario("", path).last_tick() == 1000);
    CHECK(load_scenario("", "").name == "step20");
}

TEST_CASE("a malformed joystick file is refused with file, line and what is expected") {
    CHECK_THAT(complaint("0,0,0\n"), Catch::StartsWith(":1: not four columns; expected"));
    CHECK_THAT(complaint("0,0,0,0,0\n"), Catch::StartsWith(":1: not four columns"));
    CHECK_THAT(complaint("0,0,0,0\n1,x,0,0\n"), Catch::StartsWith(":2: 'x' is not a number"));
    CHECK_THAT(complaint("0,nan,0,0\n"), Catch::StartsWith(":1: 'nan' is not a number"));
    CHECK_THAT(complaint("1,0,0,0\n0.5,0,0,0\n"), Catch::StartsWith(":2: time runs backwards"));
    CHECK_THAT(complaint("0,2001,0,0\n"), Catch::StartsWith(":1: stick position"));
    CHECK_THAT(complaint("0,0.5,0,0\n"), Catch::StartsWith(":1: stick position"));
    CHECK_THAT(complaint("0,0,0,2\n"), Catch::StartsWith(":1: estop"));
    CHECK_THAT(complaint("-1,0,0,0\n"), Catch::StartsWith(":1: time before 0"));
    CHECK_THAT(complaint("t,jx,jy,estop\n"), Catch::StartsWith(": holds no stick position"));
    CHECK_THROWS_WITH(read_joystick_file("/nonexistent/stick.csv"), Catch::Contains("cannot be read"));
}

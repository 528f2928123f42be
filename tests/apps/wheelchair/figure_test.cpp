// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "apps/wheelchair/report/figure.hpp"
#include "scratch_dir.hpp"
#include "tests/support/nasty_names.hpp"

#include <filesystem>

using namespace tandem::wheelchair;

TEST_CASE("a run is drawn as SVG") {
    const ScratchDir dir;
    draw_run(dir / "run.svg", "doorway", simulate(find_scenario("doorway")));
    const auto svg = content(dir / "run.svg");
    CHECK_THAT(svg, Catch::Contains("steering angle [deg]") && Catch::Contains("motor voltage [V]"));
    CHECK_THAT(svg, Catch::Contains("</svg>"));
}

TEST_CASE("a comparison is drawn as SVG and as PNG, even if nothing differs") {
    const ScratchDir dir;
    const auto rows = simulate(find_scenario("step20"));
    draw_comparison(dir / "fig14.svg", "step20", {{"opros", rows}, {"rtm", rows}, {"mixed", rows}});
    CHECK_THAT(content(dir / "fig14.svg"),
               Catch::Contains("difference to opros") && Catch::Contains("mixed"));
    CHECK(content(dir / "fig14.png").substr(1, 3) == "PNG");
}

TEST_CASE("neither the name nor the title of a figure is a command of gnuplot") {
    const ScratchDir dir;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(dir.path());
    auto rows = simulate(find_scenario("estop"));
    rows.resize(3);
    for (const std::string& name : tandem::test::nasty_names()) {
        if (name.find("marker") == std::string::npos) continue;
        draw_run(name + ".svg", name, rows);
        CHECK_THAT(content(name + ".svg"), Catch::Contains("</svg>"));
    }
    std::filesystem::current_path(before);
    CHECK_FALSE(std::filesystem::exists(dir / "marker"));
}

TEST_CASE("a figure that cannot be written is refused in one line") {
    CHECK_THROWS_WITH(check_figure_path("fig.pdf"), Catch::Contains(".svg or .png"));
    CHECK_THROWS_WITH(draw_run("/nonexistent/fig.svg", "", simulate(find_scenario("estop"))),
                      Catch::Contains("/nonexistent/fig.svg") || Catch::Contains("cannot be started"));
}

// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/report/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

namespace {

constexpr double step_time = 5.0, goal = 20.0; // s, deg
// Rows are 10 ms apart. Steady state is measured over the last 2 s.
constexpr std::size_t step_row = 500, last_row = 1000, steady_rows = 200;
// `unbounded` is an open lower bound. `never` is the time of an event that does not occur; as a NaN it fails
// every check.
constexpr double unbounded = -std::numeric_limits<double>::infinity();
constexpr double never = std::numeric_limits<double>::quiet_NaN();

/// Returns the time in s from the step until the steering angle first reaches `level`, interpolated.
double crossing(const std::vector<Row>& rows, double level) {
    for (std::size_t i = step_row; i < rows.size(); ++i) {
        const double now = rows[i].steering_true_deg, before = rows[i - 1].steering_true_deg;
        if (now >= level) return rows[i - 1].t + tick_seconds * (level - before) / (now - before) - step_time;
    }
    return never;
}

/// Returns the time in s from the step until the angle stays within `band` of the goal.
double settling(const std::vector<Row>& rows, double band) {
    for (std::size_t i = rows.size() - 1; i > step_row; --i)
        if (std::abs(rows[i].steering_true_deg - goal) > band) return rows[i].t + tick_seconds - step_time;
    return 0.0;
}

// Returns the maximum of value(row) from row `first`.
template <class Value>
double largest(const std::vector<Row>& rows, std::size_t first, Value value) {
    double maximum = unbounded;
    for (std::size_t i = first; i < rows.size(); ++i) maximum = std::max(maximum, value(rows[i]));
    return maximum;
}

double error_of(double angle) { return std::abs(angle - goal); }

// Returns the speed of the rear axle's middle [m/s] (docs/wheelchair.md, section 2).
double forward_speed(const Row& r) {
    return 0.5 * PlantParameters{}.wheel_radius * (r.wheel_left + r.wheel_right);
}

// Returns the error of the mean steering angle over the last 2 s.
double mean_error(const std::vector<Row>& rows) {
    double sum = 0.0;
    for (std::size_t i = rows.size() - steady_rows; i < rows.size(); ++i) sum += rows[i].steering_true_deg;
    return std::abs(sum / steady_rows - goal);
}

} // namespace

std::vector<AcceptanceCheck> check_step20(const std::vector<Row>& all) {
    if (all.size() <= last_row) return {};
    // Uses only the first 10 s, because a run with --duration can be longer.
    const std::vector<Row> rows(all.begin(), all.begin() + last_row + 1);
    const double t10 = crossing(rows, 0.1 * goal);
    const auto tail = rows.size() - steady_rows;
    return {
        {"time to 10 %", "s", t10, unbounded, 0.08},
        {"rise 10-90 %", "s", crossing(rows, 0.9 * goal) - t10, 0.30, 0.35},
        {"overshoot", "deg", largest(rows, step_row, [](const Row& r) { return r.steering_true_deg - goal; }),
         unbounded, 0.6},
        {"settling to 5 %", "s", settling(rows, 0.05 * goal), unbounded, 0.6},
        {"settling to 2 %", "s", settling(rows, 0.02 * goal), unbounded, 0.7},
        {"steady error, 8..10 s", "deg", mean_error(rows), unbounded, 0.02},
        {"steady band, true", "deg",
         largest(rows, tail, [](const Row& r) { return error_of(r.steering_true_deg); }), unbounded, 0.03},
        {"steady band, measured", "deg",
         largest(rows, tail, [](const Row& r) { return error_of(r.steering_measured_deg); }), unbounded,
         0.12},
        {"largest voltage", "V",
         largest(rows, 0,
                 [](const Row& r) { return std::max(std::abs(r.volts_left), std::abs(r.volts_right)); }),
         unbounded, 18.0},
        {"largest current", "A",
         largest(rows, 0,
                 [](const Row& r) { return std::max(std::abs(r.current_left), std::abs(r.current_right)); }),
         unbounded, 25.0},
        {"lowest speed in the turn", "m/s",
         -largest(rows, step_row, [](const Row& r) { return -forward_speed(r); }), 0.77,
         std::numeric_limits<double>::infinity()},
    };
}

Difference difference(const std::vector<Row>& a, const std::vector<Row>& b, double Row::*column, double from,
                      double to) {
    // Rows are aligned by tick, not by time of day, so that a start offset of one tick does not count as a difference.
    const auto first = static_cast<std::size_t>(std::lround(from / tick_seconds));
    const auto last =
        std::min({a.size(), b.size(), static_cast<std::size_t>(std::lround(to / tick_seconds)) + 1});
    if (first >= last) return {never, never};
    Difference d;
    double squares = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        const double e = std::abs(a[i].*column - b[i].*column);
        squares += e * e;
        d.max = std::max(d.max, e);
    }
    d.rms = std::sqrt(squares / static_cast<double>(last - first));
    return d;
}

std::vector<AcceptanceCheck> check_similar(const std::string& names, const std::vector<Row>& a,
                                           const std::vector<Row>& b) {
    const auto measured = difference(a, b, &Row::steering_measured_deg, 5.0, 10.0);
    const auto real = difference(a, b, &Row::steering_true_deg, 5.0, 10.0);
    // On real hardware, the encoder's quantization alone makes the measured angles of two runs differ by 0.04 deg rms.
    return {{names + ", measured, rms", "deg", measured.rms, unbounded, 0.06},
            {names + ", measured, max", "deg", measured.max, unbounded, 0.3},
            {names + ", true, rms", "deg", real.rms, unbounded, 0.03}};
}

std::vector<AcceptanceCheck> check_identical(const std::string& names, const std::vector<Row>& a,
                                             const std::vector<Row>& b) {
    // Rows that exist in only one run count as different.
    auto different = static_cast<double>(std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        different += csv_text({a[i]}) != csv_text({b[i]});
    return {{names + ", different rows", "", different, unbounded, 0.0}};
}

bool all_pass(const std::vector<AcceptanceCheck>& checks) {
    return std::all_of(checks.begin(), checks.end(), [](const AcceptanceCheck& j) { return j.pass(); });
}

std::string acceptance_table(const std::string& title, const std::vector<AcceptanceCheck>& checks) {
    std::string out = title + "\n";
    for (const AcceptanceCheck& j : checks) {
        std::string bounds = fmt::format("<= {:g}", j.max);
        if (std::isfinite(j.min)) bounds = fmt::format("{:g} .. {:g}", j.min, j.max);
        if (!std::isfinite(j.max)) bounds = fmt::format(">= {:g}", j.min);
        out += fmt::format("  {:<32} {:>9.4f} {:<4} {:>13}  {}\n", j.name, j.value, j.unit, bounds,
                           j.pass() ? "pass" : "FAIL");
    }
    return out;
}

} // namespace tandem::wheelchair

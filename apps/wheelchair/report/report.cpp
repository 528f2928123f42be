// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/process/output_file.hpp"
#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const std::vector<AcceptanceCheck>& checks) {
    ordered_json list = ordered_json::array();
    for (const AcceptanceCheck& j : checks) {
        // JSON has no infinity or NaN. The library writes null for an open bound or a missing value.
        list.push_back({{"name", j.name},
                        {"unit", j.unit},
                        {"value", j.value},
                        {"min", j.min},
                        {"max", j.max},
                        {"pass", j.pass()}});
    }
    return list;
}

/// Returns null in place of a figure of no sample.
ordered_json figure_of(std::size_t samples, double figure) {
    return samples > 0 ? ordered_json(figure) : ordered_json();
}

ordered_json json_of(const Statistics& s) {
    return {{"samples", s.samples},
            {"average_us", figure_of(s.samples, s.average)},
            {"deviation_us", figure_of(s.samples, s.deviation)},
            {"min_us", figure_of(s.samples, s.min)},
            {"max_us", figure_of(s.samples, s.max)}};
}

void add_latencies(ordered_json& j, const std::vector<LatencySample>& samples, Samples which) {
    const auto us = values_us(without_start(samples), which);
    j["table1"] = json_of(statistics(values_us(table_samples(samples), which)));
    j["latency_us"] = {{"samples", us.size()},
                       {"p50", figure_of(us.size(), percentile(us, 0.5))},
                       {"p99", figure_of(us.size(), percentile(us, 0.99))},
                       {"p99.9", figure_of(us.size(), percentile(us, 0.999))},
                       {"max", figure_of(us.size(), percentile(us, 1.0))}};
}

// Writes null for times that the traces do not contain.
ordered_json json_of(const HostFailure& i) {
    ordered_json j{
        {"host", i.host}, {"pid", i.pid}, {"exit_status", i.exit_status}, {"scenario_time_s", i.run_time}};
    j["motors_off_after_ms"] = i.motors_off_after_ms ? ordered_json(*i.motors_off_after_ms) : ordered_json();
    j["data_back_after_ms"] = i.data_back_after_ms ? ordered_json(*i.data_back_after_ms) : ordered_json();
    return j;
}

ordered_json json_of(const RunResult& r, const std::vector<AcceptanceCheck>& acceptance) {
    ordered_json j{{"configuration", name_of(r.configuration)},
                   {"scenario", r.scenario},
                   {"seconds", r.seconds},
                   {"ticks", r.rows.size()},
                   {"complete", r.complete()}};
    j["samples"] = {{"sent", r.samples.sent}, {"received", r.samples.received}, {"lost", r.samples.lost}};
    if (!r.latencies.empty()) {
        add_latencies(j, r.latencies, Samples::all);
        add_latencies(j["undisturbed"], r.latencies, Samples::undisturbed);
    }
    if (!r.rows.empty()) {
        const Row& last = r.rows.back();
        j["final"] = {
            {"x_m", last.x}, {"y_m", last.y}, {"heading_deg", last.heading * degrees}, {"state", last.state}};
    }
    j["acceptance"] = json_of(acceptance);
    j["host_failures"] = ordered_json::array();
    for (const HostFailure& i : r.host_failures) j["host_failures"].push_back(json_of(i));
    j["failures"] = r.failures;
    return j;
}

// Returns a line for people with the chair's final pose.
std::string final_pose(const RunResult& r) {
    if (r.rows.empty()) return "";
    const Row& last = r.rows.back();
    return fmt::format("{} {}: {} ticks, ends at x {:.3f} m, y {:.3f} m, heading {:.2f} deg\n",
                       name_of(r.configuration), r.scenario, r.rows.size(), last.x, last.y,
                       last.heading * degrees);
}

} // namespace

bool Report::good() const {
    for (const RunResult& r : runs)
        if (!r.failures.empty() || !r.host_failures.empty() || !r.complete()) return false;
    return all_pass(pairs) &&
           std::all_of(acceptance.begin(), acceptance.end(), [](const auto& list) { return all_pass(list); });
}

Report make_report(std::vector<RunResult> runs, const Options& options) {
    Report report;
    report.lockstep = options.lockstep;
    for (const RunResult& r : runs) {
        const bool step = r.scenario == "step20" && options.joystick_file.empty() && r.host_failures.empty();
        report.acceptance.push_back(step ? check_step20(r.first_rows()) : std::vector<AcceptanceCheck>{});
    }
    // With --compare, the last run is the mixed one. It is compared with each run of one model.
    for (std::size_t i = 0; runs.size() > 1 && i + 1 < runs.size(); ++i) {
        const auto name =
            fmt::format("{} - {}", name_of(runs.back().configuration), name_of(runs[i].configuration));
        std::vector<AcceptanceCheck> pair;
        if (options.lockstep)
            pair = check_identical(name, runs.back().rows, runs[i].rows);
        else if (runs[i].scenario == "step20")
            pair = check_similar(name, runs.back().first_rows(), runs[i].first_rows());
        report.pairs.insert(report.pairs.end(), pair.begin(), pair.end());
    }
    report.runs = std::move(runs);
    return report;
}

std::string text_of(const Report& report) {
    std::string out;
    for (const RunResult& r : report.runs) out += final_pose(r);
    std::vector<LatencyRow> latencies;
    for (const RunResult& r : report.runs)
        if (!report.lockstep && r.configuration != Configuration::memory)
            latencies.push_back({name_of(r.configuration), r.latencies, r.samples});
    if (!latencies.empty()) out += latency_tables(latencies);
    for (std::size_t i = 0; i < report.runs.size(); ++i)
        if (!report.acceptance[i].empty())
            out += acceptance_table("Step of 20 deg, " + name_of(report.runs[i].configuration),
                                    report.acceptance[i]);
    if (!report.pairs.empty())
        out += acceptance_table(report.lockstep ? "Lock-step logs" : "Difference of steering angles, 5..10 s",
                                report.pairs);
    return out;
}

void write_json(const std::string& path, const Report& report) {
    ordered_json j{{"lockstep", report.lockstep}, {"good", report.good()}};
    j["runs"] = ordered_json::array();
    for (std::size_t i = 0; i < report.runs.size(); ++i)
        j["runs"].push_back(json_of(report.runs[i], report.acceptance[i]));
    j["pairs"] = json_of(report.pairs);
    process::write_output(path, j.dump(2) + "\n");
}

} // namespace tandem::wheelchair

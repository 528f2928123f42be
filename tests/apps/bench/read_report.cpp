// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/bench/read_report.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace tandem::bench::test {

namespace {

using Json = nlohmann::json;

Row row_from(const Json& in) {
    Row row;
    const auto text = [&](const char* key) { return in.at(key).get<std::string>(); };
    row.id = text("case");
    row.group = text("group");
    row.subject = text("subject");
    row.operation = text("operation");
    row.bytes = in.at("bytes");
    row.wake = text("wake");
    row.conditions = text("conditions");
    row.power_profile = text("power_profile");
    row.placement = text("placement");
    row.loaded = in.at("loaded");
    row.detail = text("detail");
    row.unit = text("unit");
    row.cores = text("cores");
    row.measured_again = in.at("measured_again");
    if (in.contains("skipped")) {
        row.skipped = text("skipped");
        return row;
    }
    Summary& s = row.summary;
    s.samples = in.at("samples");
    s.p25 = in.at("p25");
    s.p50 = in.at("p50");
    s.p75 = in.at("p75");
    s.p90 = in.at("p90");
    s.p99 = in.at("p99");
    s.p999 = in.at("p99.9");
    s.max = in.at("max");
    row.foreign_cpu_share = in.at("foreign_cpu_share");
    // JSON has no NaN: the library writes null for it.
    for (const Json& run : in.at("runs")) row.runs.push_back(run.is_null() ? NAN : run.get<double>());
    for (const Json& point : in.at("curve")) s.curve.push_back({point.at(0), point.at(1)});
    if (in.contains("overruns")) row.tick_counts = {in.at("overruns"), in.at("periods_skipped")};
    if (in.contains("windows"))
        row.window_counts = {in.at("windows"), in.at("windows_dropped"), in.at("floor_ns")};
    if (in.contains("path")) {
        const Json& path = in.at("path");
        row.path_counts = {path.at("instructions"), path.at("code_lines"), path.at("code_pages"),
                           path.at("allocations"),  path.at("locked"),     path.at("system_calls")};
        row.path_functions = path.at("functions");
    }
    return row;
}

} // namespace

Report from_json(const std::string& text) {
    const Json in = Json::parse(text);
    Report report;
    const Json& m = in.at("machine");
    report.machine = {m.at("kernel"), m.at("processor"), m.at("clock"), m.at("date"), m.at("cores")};
    for (const Json& row : in.at("rows")) report.rows.push_back(row_from(row));
    return report;
}

} // namespace tandem::bench::test

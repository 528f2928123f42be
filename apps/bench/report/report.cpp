// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/report.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace tandem::bench {

namespace {

// Ordered: a reader of the file finds the name of the case first.
using Json = nlohmann::ordered_json;
// 2: group "baseline" and "tandem" instead of "floor" and "ours"; "subject", "operation" and "power_profile"
// instead of "who", "what" and "regime"; "conditions" and "loaded" added; "foreign" is "foreign_cpu_share".
constexpr int format_version = 2;

/// Pairs of share and value.
Json curve_json(const std::vector<CurvePoint>& curve) {
    Json out = Json::array();
    for (const CurvePoint& point : curve) out.push_back({point.share, point.value});
    return out;
}

/// The kernel is repeated in each row, so that a row says under which conditions it was measured on its own.
Json row_json(const Row& row, const Machine& machine) {
    Json out{{"case", row.id},
             {"group", row.group},
             {"subject", row.subject},
             {"operation", row.operation},
             {"bytes", row.bytes},
             {"wake", row.wake},
             {"conditions", row.conditions},
             {"power_profile", row.power_profile},
             {"placement", row.placement},
             {"loaded", row.loaded},
             {"detail", row.detail},
             {"unit", row.unit},
             {"cores", row.cores},
             {"kernel", machine.kernel},
             {"timed_from", row.timed_from()},
             {"measured_again", row.measured_again}};
    // A row without figures has none of the keys below.
    if (!row.skipped.empty()) {
        out["skipped"] = row.skipped;
        return out;
    }
    const Summary& s = row.summary;
    out.update({{"samples", s.samples},
                {"p25", s.p25},
                {"p50", s.p50},
                {"p75", s.p75},
                {"p90", s.p90},
                {"p99", s.p99},
                {"p99.9", s.p999},
                {"max", s.max},
                {"foreign_cpu_share", row.foreign_cpu_share},
                {"runs", row.runs},
                {"curve", curve_json(s.curve)}});
    if (row.tick_counts) {
        out["overruns"] = row.tick_counts->overruns;
        out["periods_skipped"] = row.tick_counts->skipped;
    }
    if (row.window_counts) {
        out["windows"] = row.window_counts->kept;
        out["windows_dropped"] = row.window_counts->dropped;
        out["floor_ns"] = row.window_counts->floor_ns;
    }
    if (row.path_counts)
        out["path"] = {{"instructions", row.path_counts->instructions},
                       {"code_lines", row.path_counts->code_lines},
                       {"code_pages", row.path_counts->code_pages},
                       {"allocations", row.path_counts->allocations},
                       {"locked", row.path_counts->locked},
                       {"system_calls", row.path_counts->system_calls},
                       {"functions", row.path_functions}};
    return out;
}

/// The inverse of row_json(). Throws what the library throws for a missing key or a wrong type.
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
    row.measured_again = in.value("measured_again", row.measured_again); // of reports since 0.2.0
    if (in.contains("skipped")) {
        row.skipped = text("skipped");
        return row;
    }
    Summary& s = row.summary;
    s.samples = in.at("samples");
    s.p25 = in.value("p25", s.p25); // of reports since 0.2.0
    s.p50 = in.at("p50");
    s.p75 = in.value("p75", s.p75);
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
        row.window_counts = {in.at("windows"), in.at("windows_dropped"), in.value("floor_ns", 0.0)};
    if (in.contains("path")) {
        const Json& path = in.at("path");
        row.path_counts = {path.at("instructions"), path.at("code_lines"), path.at("code_pages"),
                           path.at("allocations"),  path.at("locked"),     path.at("system_calls")};
        row.path_functions = path.at("functions");
    }
    return row;
}

} // namespace

const Row* Report::find(const std::string& id) const {
    for (const Row& row : rows)
        if (row.id == id && row.skipped.empty()) return &row;
    return nullptr;
}

std::string to_json(const Report& report) {
    const Machine& m = report.machine;
    Json out{{"tandem_bench", format_version},
             {"machine",
              {{"kernel", m.kernel},
               {"processor", m.processor},
               {"cores", m.cores},
               {"clock", m.clock},
               {"date", m.date}}},
             {"rows", Json::array()}};
    for (const Row& row : report.rows) out["rows"].push_back(row_json(row, m));
    // One row a line: readable, and a difference between two files shows the row.
    std::string text = "{\"tandem_bench\":" + std::to_string(format_version) +
                       ",\n\"machine\":" + out["machine"].dump() + ",\n\"rows\":[";
    for (std::size_t i = 0; i < out["rows"].size(); ++i)
        text += (i == 0 ? "\n" : ",\n") + out["rows"][i].dump();
    return text + "\n]}\n";
}

Report from_json(const std::string& text) {
    try {
        const Json in = Json::parse(text);
        if (in.at("tandem_bench") != format_version)
            throw std::runtime_error("has another format version of tandem-bench; expected " +
                                     std::to_string(format_version) + "; measure again with this one");
        Report report;
        const Json& m = in.at("machine");
        report.machine = {m.at("kernel"), m.at("processor"), m.at("clock"), m.at("date"), m.at("cores")};
        for (const Json& row : in.at("rows")) report.rows.push_back(row_from(row));
        return report;
    } catch (const nlohmann::json::exception& failure) { // no JSON at all, or not the keys of a report
        throw std::runtime_error(std::string("is not a report of tandem-bench (") + failure.what() +
                                 "); give a file written with --json");
    }
}

} // namespace tandem::bench

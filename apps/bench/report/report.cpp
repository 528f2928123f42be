// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/report.hpp"

#include <nlohmann/json.hpp>

namespace tandem::bench {

namespace {

// In this order, so that a reader of the file first finds the name of the case.
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

/// Each row repeats the kernel, so that a row alone shows the conditions of its measurement.
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
    // One row per line: readable, and a difference between two files shows the row.
    std::string text = "{\"tandem_bench\":" + std::to_string(format_version) +
                       ",\n\"machine\":" + out["machine"].dump() + ",\n\"rows\":[";
    for (std::size_t i = 0; i < out["rows"].size(); ++i)
        text += (i == 0 ? "\n" : ",\n") + out["rows"][i].dump();
    return text + "\n]}\n";
}

} // namespace tandem::bench

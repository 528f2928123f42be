// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/html.hpp"

#include "apps/bench/report/plot.hpp"
#include "apps/bench/report/table.hpp"

#include <fmt/format.h>

#include <map>

namespace tandem::bench {

namespace {

// Inside the page, as the plots are: it must be readable without a network, from an archive, years later.
constexpr const char* style =
    "body{font:15px/1.5 Helvetica,Arial,sans-serif;color:#222;max-width:1100px;margin:2em auto;padding:0 1em}"
    "h1{font-size:1.5em}h2{font-size:1.15em;margin:2em 0 .4em}p{max-width:48em}"
    "table{border-collapse:collapse;font-size:13px}th,td{padding:2px 9px;border-bottom:1px solid "
    "#e4e4e4;text-align:right;"
    "white-space:nowrap}th:first-child,td:first-child{text-align:left}thead th{border-bottom:2px solid #999}"
    "tr.tandem td:first-child{color:#0072b2;font-weight:bold}tr.baseline td:first-child{color:#666}"
    ".pass{color:#00704a}.FAIL{color:#b00020;font-weight:bold}.disturbed{color:#b26a00}"
    ".wide{overflow-x:auto}svg{width:100%;height:auto}";

/// Text for an element; for attributes it would have to escape quotes, too.
std::string escaped(const std::string& text) {
    static const std::map<char, const char*> entities{{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}};
    std::string out;
    for (char c : text) {
        const auto entity = entities.find(c);
        out += entity == entities.end() ? std::string(1, c) : entity->second;
    }
    return out;
}

/// Cells of a table row, with their text escaped.
std::string cells(std::initializer_list<std::string> texts, const char* tag = "td") {
    std::string out;
    for (const std::string& text : texts) out += fmt::format("<{0}>{1}</{0}>", tag, escaped(text));
    return out;
}

/// A table of the limits, or nothing if they were not checked.
std::string acceptance_section(const std::vector<AcceptanceResult>& results) {
    if (results.empty()) return {};
    std::string out = "<h2>Acceptance limits</h2>\n<table><thead><tr>" +
                      cells({"ratio within one run, median of all that were measured", "measured", "min",
                             "max", "limit", ""},
                            "th") +
                      "</tr></thead><tbody>\n";
    for (const AcceptanceResult& result : results) {
        const std::string limit = fmt::format(
            "{} {:g}",
            result.limit.comparison == AcceptanceLimit::Comparison::at_most ? "at most" : "at least",
            result.limit.limit);
        if (!result.skipped.empty())
            out += "<tr>" + cells({result.limit.description, "-", "-", "-", limit, result.verdict()}) +
                   "</tr>\n";
        else
            out += "<tr>" +
                   cells({result.limit.description, fmt::format("{:.3f}", result.value),
                          fmt::format("{:.3f}", result.min), fmt::format("{:.3f}", result.max), limit}) +
                   fmt::format("<td class=\"{}\">{}</td></tr>\n", result.passed() ? "pass" : "FAIL",
                               result.verdict());
    }
    return out + "</tbody></table>\n";
}

/// The class of the row selects its colour in the style sheet.
std::string row_html(const Row& row) {
    const Summary& s = row.summary;
    const auto tail = [&](double value) { return row.is_latency() ? figure_text(value) : std::string("-"); };
    std::string note = row.measured_again > 0 ? measurements_text(row.runs) + " " : "";
    if (row.is_disturbed())
        note += fmt::format("disturbed: others used {:.0f} %", row.foreign_cpu_share * 100);
    return fmt::format("<tr class=\"{}\">", row.group) +
           cells({row.id, row.unit, row.wake, row.conditions, row.cores, std::to_string(s.samples),
                  figure_text(s.p50), tail(s.p90), tail(s.p99), tail(s.p999), figure_text(s.max),
                  row.timed_from()}) +
           fmt::format("<td class=\"disturbed\">{}</td></tr>\n", note);
}

/// The table of all rows with figures, and a list of those without, with the reason.
std::string rows_section(const Report& report) {
    std::string out =
        "<h2>Every row</h2>\n<p>Of a stream, p50 and max are the median and the best of its windows.</p>\n"
        "<div class=\"wide\"><table><thead><tr>" +
        cells({"case", "unit", "wake", "conditions", "cores", "samples", "p50", "p90", "p99", "p99.9", "max",
               "from", ""},
              "th") +
        "</tr></thead><tbody>\n";
    std::string skipped; // collected, for the list behind the table
    for (const Row& row : report.rows) {
        if (row.skipped.empty())
            out += row_html(row);
        else
            skipped += "<li>" + escaped(row.id + ": " + row.skipped) + "</li>\n";
    }
    out += "</tbody></table></div>\n";
    if (!skipped.empty()) out += "<h2>Skipped</h2>\n<ul>\n" + skipped + "</ul>\n";
    return out;
}

} // namespace

std::string html_page(const Report& report, const std::vector<AcceptanceResult>& acceptance) {
    // The conditions first: a figure without them means nothing.
    const Machine& m = report.machine;
    std::size_t runs = 0;
    for (const Row& row : report.rows) runs = std::max(runs, row.runs.size() - row.measured_again);
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<title>tandem-bench "
        "{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>tandem-bench, {0}</h1>\n",
        escaped(m.date), style);
    out += fmt::format(
        "<p>{}, {} cores, {}. Clock: {}. Runs: {}. Two processes, one pinned to each of the row's cores; "
        "latency is "
        "half a round trip where the row says one-way, and a round trip elsewhere; every message's number "
        "and content are checked. "
        "Absolute figures belong to this machine and hour: compare ratios.</p>\n",
        escaped(m.processor), m.cores, escaped(m.kernel), escaped(m.clock), runs);
    out += acceptance_section(acceptance);
    for (const Plot& plot : draw_plots(report))
        out += "<h2>" + escaped(plot.title) + "</h2>\n" + plot.svg + "\n";
    return out + rows_section(report) + "</body>\n</html>\n";
}

} // namespace tandem::bench

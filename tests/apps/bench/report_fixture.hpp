// SPDX-License-Identifier: Apache-2.0
// Makes reports for the tests.
#pragma once
#include "apps/bench/report/report.hpp"

#include <cmath>

namespace tandem::bench::test {

inline Row row(const std::string& id, std::vector<double> runs, const std::string& unit = "ns") {
    Row out;
    out.id = id;
    out.group = id.substr(0, id.find('/'));
    out.subject = "ring";
    out.operation = "one-way";
    out.wake = "spin";
    out.conditions = "normal";
    out.power_profile = "normal";
    out.placement = "processes";
    out.unit = unit;
    out.cores = "0,1";
    out.bytes = 64;
    std::vector<Summary> summaries;
    for (double run : runs)
        if (!std::isnan(run)) summaries.push_back(summarize(std::vector<double>(100, run)));
    out.summary = median_of(summaries);
    out.runs = std::move(runs);
    return out;
}

inline Row skipped(const std::string& id, const std::string& reason) {
    Row out;
    out.id = id;
    out.group = "peer";
    out.skipped = reason;
    return out;
}

inline Report report(std::vector<Row> rows) {
    return {{"Linux 6.1 x86_64", "Some \"processor\" <1>", "rdtsc", "2026-01-02 03:04:05", 2},
            std::move(rows)};
}

} // namespace tandem::bench::test

// SPDX-License-Identifier: Apache-2.0
// The commands that show running links as a whole. Each prints its result and returns the exit code; errors are exceptions
// of one line.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

struct TopOptions {
    std::vector<std::string> links; ///< none: all
    double period_s = 1;            ///< one picture for each
    std::uint64_t count = 0;        ///< pictures after which to end; 0: never
    bool json = false;
};
int top(const TopOptions& options);

enum class GraphFormat { text, dot, svg, json };
struct GraphOptions {
    std::vector<std::string> links; ///< none: all
    GraphFormat format = GraphFormat::text;
};
int graph(const GraphOptions& options);

} // namespace tandem::command

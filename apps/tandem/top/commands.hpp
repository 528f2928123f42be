// SPDX-License-Identifier: Apache-2.0
// The commands that show all running links. Each function prints its result and returns the exit code. Each throws
// exceptions with a one-line message.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

struct TopOptions {
    std::vector<std::string> links; ///< empty: all
    double period_s = 1;            ///< time between two outputs
    std::uint64_t count = 0;        ///< number of outputs; 0: unlimited
    bool json = false;
};
int top(const TopOptions& options);

enum class GraphFormat { text, dot, svg, json };
struct GraphOptions {
    std::vector<std::string> links; ///< empty: all
    GraphFormat format = GraphFormat::text;
};
int graph(const GraphOptions& options);

} // namespace tandem::command

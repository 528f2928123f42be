// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/suite.hpp"

namespace tandem::bench {

struct Options {
    std::string only, json, html, compare;
    bool list = false, quick = false, bar = false, quiet = false;
    int runs = 0; ///< 0: one, or five with --bar
    std::vector<int> cores;
};

/// Reads the command line; prints help or the error and sets `exit_code` if the program is to end.
Options read_options(int argc, char** argv, int& exit_code);

Budget budget_of(const Options& options);

/// Two cores of those that this process may use: the ones asked for, or the first two, or one twice.
Cores cores_of(const Options& options);

} // namespace tandem::bench

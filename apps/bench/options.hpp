// SPDX-License-Identifier: Apache-2.0
// The command line of tandem-bench.
#pragma once
#include "apps/bench/suite.hpp"

namespace tandem::bench {

struct Options {
    std::string only, json;
    bool list = false, path_functions = false, quick = false, acceptance = false, quiet = false;
    std::size_t tail_messages = 0; ///< 0: those of the budget
    int runs = 0;                  ///< 0: one, or five with --acceptance
    std::vector<int> cores;        ///< of A and B; empty: the first two that are allowed
};

/// Reads the command line. If the program is to end, it has printed help or the error, and exit_code is not -1.
Options read_options(int argc, char** argv, int& exit_code);

/// Of a case: for seconds with --quick, else for minutes.
Budget budget_of(const Options& options);

/// Two of the cores that this process may use: those of --cores, or the first two, or the only one twice. Throws
/// std::runtime_error if --cores names another.
Cores cores_of(const Options& options);

} // namespace tandem::bench

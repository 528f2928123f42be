// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_PROCESS_H
#define COIL_PROCESS_H
#include <coil/stringutil.h>
#include <cstdlib>
#include <string>
#include <unistd.h>
#include <vector>

namespace coil {

/// Starts a command and does not wait for it. Returns 0 or -1. Splits arguments at blanks; no shell interprets them.
int launch_shell(const std::string& command);
/// Runs a command through the shell to its end and adds its output lines to `out`. Returns 0 or -1.
int create_process(const std::string& command, std::vector<std::string>& out);
int daemon(int nochdir, int noclose);

} // namespace coil
#endif

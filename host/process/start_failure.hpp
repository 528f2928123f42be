// SPDX-License-Identifier: Apache-2.0
// What to do when the system refuses a thread or a process.
#pragma once
#include <exception>
#include <string>

namespace tandem::process {

/// Returns the remedy for an errno value of clone(), fork() or pidfd_open(), beginning with "; ": names the limit and its
/// value. Empty for other errors.
std::string start_remedy(int error);

/// Returns the text of an exception as one line for users. Says what failed, and the remedy, if std::thread() threw it:
/// its text is only that of errno.
std::string explain(const std::exception& error);

} // namespace tandem::process

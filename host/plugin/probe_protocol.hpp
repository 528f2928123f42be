// SPDX-License-Identifier: Apache-2.0
// The protocol from a probe's child process to its parent: lines on process::report_descriptor, each with one of
// these tags, the result last. Internal to host/plugin.
#pragma once

namespace tandem::plugin {

constexpr char probe_argument[] =
    "--probe-in-child";                  ///< the child's first argument, before task, library, arguments
constexpr char stage_tag[] = "stage ";   ///< the library's function that runs next
constexpr char failed_tag[] = "failed "; ///< the reason
constexpr char result_tag[] = "result "; ///< number of bytes, newline, that many bytes
constexpr char done_line[] = "done\n";   ///< the last line; if missing, the child ended early

} // namespace tandem::plugin

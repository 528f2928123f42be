// SPDX-License-Identifier: Apache-2.0
// Words between the two sides of a probe: lines on report_descriptor, the result last.
#pragma once

namespace tandem::plugin {

constexpr char probe_argument[] = "--probe-in-child"; ///< first argument; then task, library, arguments
constexpr char stage_tag[] = "stage ";
constexpr char failed_tag[] = "failed ";
constexpr char result_tag[] = "result "; ///< number of bytes, newline, that many bytes
constexpr char done_line[] = "done\n";   ///< last; without it the process has ended half-way

} // namespace tandem::plugin

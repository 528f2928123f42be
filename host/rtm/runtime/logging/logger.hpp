// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace RTC {

/// Tries once more to report lines of the log that nobody has taken. Waits for no reader. [any-thread]
void report_lost_log_lines();

} // namespace RTC

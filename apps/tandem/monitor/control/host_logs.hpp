// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <nlohmann/json.hpp>

namespace tandem::monitor {

/// Returns the new lines of the logs of the hosts in the state. A log is the standard error of a host, or of the `tandem run`
/// that reads it, if it is a file of this user. `from`: {id: offset}, from the last answer; a log that is not in it begins with
/// its last 64 KiB. The answer is a list of {"id", "hosts", "text", "next"}: `text` has whole lines, `next` is the offset
/// after them.
nlohmann::json read_host_logs(const State& state, const nlohmann::json& from);

} // namespace tandem::monitor

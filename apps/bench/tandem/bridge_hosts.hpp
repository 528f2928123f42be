// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/session.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::bench {

/// The direction is the case's detail.
inline bool opros_to_rtm(const Session& session) { return session.bench_case().detail == "opros-to-rtm"; }

/// The file in that folder into which a component writes its samples.
std::filesystem::path samples_file(const std::filesystem::path& folder);

/// A case across the bridge: A runs opros_host on app.xml and B rtm_host on rtc.conf, which `write_files` writes into the
/// folder, with these arguments in addition, until a component has written its samples. Throws std::runtime_error when a
/// host ends before.
void measure_between_hosts(Session& session,
                           void (*write_files)(const Session& session, const std::filesystem::path& folder),
                           const std::vector<std::string>& host_arguments = {});

} // namespace tandem::bench

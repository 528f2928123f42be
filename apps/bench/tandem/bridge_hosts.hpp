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
/// Returns the samples in that file.
std::vector<double> doubles_in(const std::filesystem::path& file);

/// Whether the case is the ratio to a floor in alternation: its samples are the ratios of windows, not a number for a window in
/// which a host lost its core.
inline bool is_paired(const Session& session) { return session.bench_case().unit == Unit::ratio; }
/// Whether it is the ratio of a tail to that of the minimal ring in alternation: its samples are those of both, the latter with a minus.
inline bool is_tail(const Session& session) { return session.bench_case().operation.starts_with("tail-"); }
/// The shared memory of a paired case's floor, which both hosts map; empty if the case is none.
std::string floor_file(const Session& session);
/// Whether a paired case leaves 100 ms or more between two messages, so that each of its windows takes long.
bool has_long_windows(const Session& session);
/// How often a paired case goes from the bridge to its floor and back, and how many windows before do not count.
std::size_t paired_windows(const Session& session);
constexpr std::size_t paired_warm_up = 5;

/// A case across the bridge: A runs opros_host on app.xml and B rtm_host on rtc.conf, which `write_files` writes into the
/// folder, with these arguments in addition, until a component has written its samples. Throws std::runtime_error when a
/// host ends before.
void measure_between_hosts(Session& session,
                           void (*write_files)(const Session& session, const std::filesystem::path& folder),
                           const std::vector<std::string>& host_arguments = {});

} // namespace tandem::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/session.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::bench {

/// Returns whether the case measures that direction, which is its detail.
inline bool opros_to_rtm(const Session& session) { return session.bench_case().detail == "opros-to-rtm"; }

/// Returns the file in that folder into which a component writes its samples.
std::filesystem::path samples_file(const std::filesystem::path& folder);
/// Returns the samples in that file.
std::vector<double> doubles_in(const std::filesystem::path& file);

/// Returns whether the case is the ratio to a floor in alternation. Its samples are the ratios of windows;
/// NaN for a window in which a host lost its core.
inline bool is_paired(const Session& session) { return session.bench_case().unit == Unit::ratio; }
/// Returns whether the case is the ratio of a tail to that of the minimal ring in alternation. Its samples
/// are those of both; those of the ring have a minus sign.
inline bool is_tail(const Session& session) { return session.bench_case().operation.starts_with("tail-"); }
/// Returns the shared memory of a paired case's floor, which both hosts map; empty for other cases.
std::string floor_file(const Session& session);
/// Returns whether a paired case has 100 ms or more between two messages, so that each of its windows takes
/// long.
bool has_long_windows(const Session& session);
/// Returns the number of windows of a paired case: how often it changes from the bridge to its floor and back.
std::size_t paired_windows(const Session& session);
constexpr std::size_t paired_warm_up = 5;

/// Runs a case across the bridge: A runs opros_host with app.xml and B rtm_host with rtc.conf, which
/// `write_files` writes into the folder, with these additional arguments, until a component has written its
/// samples. Throws std::runtime_error if a host ends earlier.
void measure_between_hosts(Session& session,
                           void (*write_files)(const Session& session, const std::filesystem::path& folder),
                           const std::vector<std::string>& host_arguments = {});

} // namespace tandem::bench

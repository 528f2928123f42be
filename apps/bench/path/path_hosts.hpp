// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/tandem/bench_host.hpp"

#include <optional>

namespace tandem::bench {

/// Where a message or a call goes.
enum class Road { opros_to_rtm, rtm_to_opros, inside_opros, inside_rtm };

/// The hosts of a road, each with a component BenchPath. `from` does the operation and `to` takes part; inside one host
/// both are the same process.
class PathHosts {
  public:
    /// Writes the profiles into the folder and starts the hosts. `link`: the name of the link across. The operation is
    /// a call, or a message of 6 doubles. Throws std::system_error.
    PathHosts(Road road, bool is_call, const std::string& link, const std::filesystem::path& folder);

    pid_t from() const { return road_ == Road::rtm_to_opros || !opros_ ? rtm_->pid() : opros_->pid(); }
    pid_t to() const { return road_ == Road::rtm_to_opros || !rtm_ ? opros_->pid() : rtm_->pid(); }
    /// Of each host, for the message of an error.
    std::string first_log_lines() const;

  private:
    Road road_;
    std::optional<BenchHost> opros_, rtm_;
};

} // namespace tandem::bench

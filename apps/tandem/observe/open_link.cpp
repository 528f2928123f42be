// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/open_link.hpp"

#include "apps/tandem/output/format.hpp"
#include "apps/tandem/shm/segment_format.hpp"
#include "host/text/join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace tandem::command {
namespace {

std::string names_of(const std::vector<FollowedPort>& ports) {
    const std::string names = text::join(
        ports, ", ", [](const FollowedPort& port) { return replace_nonprintable(port.port.name); });
    return names.empty() ? "none" : names;
}

} // namespace

LinkFollower open_link(const std::string& link, const std::vector<std::string>& ports) {
    const shm::Observation observation = observe_or_throw(link, 0);
    if (observation.segment.readability != shm::Readability::readable)
        throw std::runtime_error(fmt::format("{}: {}", observation.segment.path, observation.segment.reason));
    const auto known = find_ports(observation);
    for (const std::string& name : ports)
        if (std::none_of(known.begin(), known.end(),
                         [&](const FollowedPort& port) { return port.port.name == name; }))
            throw std::runtime_error(fmt::format("link '{}' has no data port '{}'; its data ports: {}", link,
                                                 name, names_of(known)));
    LinkFollower follower(link, ports);
    follower.poll([](const LinkFollower::Port&, const shm::FollowedRecord&) {});
    return follower;
}

void sleep_between_looks() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

} // namespace tandem::command

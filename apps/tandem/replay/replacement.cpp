// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/replacement.hpp"

#include "shm/inspect/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::command {
namespace {

using shm::Side;

bool is_there(const std::optional<shm::Observation>& observation, Side side) {
    if (!observation || observation->segment.readability != shm::Readability::readable) return false;
    const auto state = observation->segment.side(side).state;
    return state == shm::PeerState::alive || state == shm::PeerState::stopped;
}

Side absent_side(const std::string& link) {
    const auto observation = shm::observe(link);
    const bool first = is_there(observation, Side::first), second = is_there(observation, Side::second);
    if (first != second) return first ? Side::second : Side::first;
    if (!first)
        throw std::runtime_error(
            fmt::format("link '{}': no host is running; start the host that stays, or choose the host to "
                        "replace with --in-place-of opros_host or rtm_host",
                        link));
    throw std::runtime_error(fmt::format("link '{}': opros_host (pid {}) and rtm_host (pid {}) are both "
                                         "running; stop the one that the replay is to replace",
                                         link, observation->segment.side(Side::first).pid,
                                         observation->segment.side(Side::second).pid));
}

/// Returns the sides that share the component. A side is one process and is replaced completely.
Replacement sides_of_component(const Recording& recording, const std::string& component) {
    Replacement found;
    std::string known;
    for (const auto& [name, link] : recording.links())
        for (const Side side : {Side::first, Side::second})
            for (const auto& each : link.table(side).components) {
                known += (known.empty() ? "" : ", ") + each.name;
                if (each.name == component) found[name] = side;
            }
    if (found.empty())
        throw std::runtime_error(
            fmt::format("no link of the recording shares a component '{}': it has opros_host, rtm_host{}{}",
                        component, known.empty() ? "" : ", ", known));
    for (const auto& [name, side] : found)
        for (const auto& each : recording.links().at(name).table(side).components)
            if (each.name != component)
                throw std::runtime_error(fmt::format("component '{}' shares link '{}' with '{}' on the same "
                                                     "side: replace the host instead, with --in-place-of {}",
                                                     component, name, each.name,
                                                     side == Side::first ? "opros_host" : "rtm_host"));
    return found;
}

} // namespace

std::string present_name(const std::string& recorded, const ReplayOptions& options) {
    return options.link.empty() ? recorded : options.link;
}

Replacement find_replacement(const Recording& recording, const ReplayOptions& options) {
    if (!options.link.empty() && recording.links().size() != 1)
        throw std::runtime_error(fmt::format("--link requires a recording with one link, but {} has {}",
                                             options.file.string(), recording.links().size()));
    const std::string& who = options.in_place_of;
    if (!who.empty() && who != "opros_host" && who != "rtm_host") return sides_of_component(recording, who);
    if (who.empty() && !options.lockstep.empty())
        throw std::runtime_error(
            "--lockstep requires --in-place-of opros_host or rtm_host; it starts the other host");
    Replacement replacement;
    for (const auto& [name, link] : recording.links())
        replacement[name] = who.empty() ? absent_side(present_name(name, options))
                                        : (who == "opros_host" ? Side::first : Side::second);
    return replacement;
}

} // namespace tandem::command

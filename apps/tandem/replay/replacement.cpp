// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/replacement.hpp"

#include "apps/tandem/output/format.hpp"
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

/// Returns the side's host for a message.
std::string describe_host(const RecordedLink& link, Side side) {
    const std::string host = link.host_of(side);
    return host.empty() ? "a host of unknown model" : host;
}

Side absent_side(const RecordedLink& recorded, const std::string& link) {
    const auto observation = shm::observe(link);
    const bool first = is_there(observation, Side::first), second = is_there(observation, Side::second);
    if (first != second) return first ? Side::second : Side::first;
    if (!first)
        throw std::runtime_error(
            fmt::format("link '{}': no host is running; start the host that stays, or choose the host to "
                        "replace with --in-place-of opros_host or rtm_host",
                        link));
    const auto pid = [&](Side side) {
        const auto& there = observation->segment.side(side);
        return format_pid(there.pid, there.pid_elsewhere);
    };
    throw std::runtime_error(
        fmt::format("link '{}': {} ({}) and {} ({}) are both running; stop the one that the replay replaces",
                    link, describe_host(recorded, Side::first), pid(Side::first),
                    describe_host(recorded, Side::second), pid(Side::second)));
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
    for (const auto& [name, side] : found) {
        const RecordedLink& link = recording.links().at(name);
        for (const auto& each : link.table(side).components)
            if (each.name != component)
                throw std::runtime_error(
                    fmt::format("component '{}' shares link '{}' with '{}' on the same side: replace the "
                                "host instead, with --in-place-of {}",
                                component, name, each.name, link.host_of(side)));
    }
    return found;
}

/// Returns the sides of this host. Not every link needs to have one: `wheelchair` has a link with itself.
Replacement sides_of_host(const Recording& recording, const std::string& host) {
    Replacement found;
    for (const auto& [name, link] : recording.links())
        for (const Side side : {Side::first, Side::second})
            if (link.host_of(side) == host) found[name] = side;
    return found;
}

Replacement absent_sides(const Recording& recording, const ReplayOptions& options) {
    Replacement absent;
    for (const auto& [name, link] : recording.links())
        absent[name] = absent_side(link, present_name(name, options));
    return absent;
}

/// What a side does when its peer comes depends on its model.
void require_models(const Recording& recording, const Replacement& replacement,
                    const std::filesystem::path& file) {
    const auto is_unknown = [&](const auto& each) {
        return recording.links().at(each.first).host_of(each.second).empty();
    };
    if (replacement.empty() || std::any_of(replacement.begin(), replacement.end(), is_unknown))
        throw std::runtime_error(
            fmt::format("{}: the port tables of the recording do not name the host to replace; record again",
                        file.string()));
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
    if (who.empty() && !options.lockstep.empty())
        throw std::runtime_error(
            "--lockstep requires --in-place-of opros_host or rtm_host; it starts the other host");
    auto replacement = who.empty()                                ? absent_sides(recording, options)
                       : who == "opros_host" || who == "rtm_host" ? sides_of_host(recording, who)
                                                                  : sides_of_component(recording, who);
    require_models(recording, replacement, options.file);
    return replacement;
}

} // namespace tandem::command

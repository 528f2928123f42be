// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/state_reader.hpp"

#include "apps/tandem/output/format.hpp"
#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace tandem::monitor {
namespace {

std::uint64_t milliseconds_since_epoch() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

/// Notes what was left out because of a limit. Only the first note is kept, so that the text is one line.
void add_cut(State& state, const std::string& text) {
    if (state.cut.empty()) state.cut = text;
}

/// Copies a link from an earlier state, if that state has it.
void keep_link(const std::string& name, const State& before, State& state) {
    const std::string shown = command::replace_nonprintable(name);
    for (const LinkState& link : before.links)
        if (link.name == shown) return state.links.push_back(link);
}

} // namespace

void StateReader::read_link(const std::string& name, State& state, Round& round) {
    auto observation = shm::observe(name);
    const std::uint64_t now_ns = shm::now_ns();
    if (!observation) return; // removed since it was listed
    LinkReader& reader = links_.try_emplace(name, name).first->second;
    state.links.push_back(reader.read(std::move(*observation), now_ns, round));
    if (reader.was_cut())
        add_cut(state,
                fmt::format("link {}: not all messages were read; one scan of all links reads for at most "
                            "{} and {} MiB",
                            state.links.back().name, command::format_duration(bounds_.time_ns),
                            bounds_.message_bytes >> 20));
}

std::set<std::string> StateReader::list_links(State& state) const {
    std::set<std::string> names;
    auto segments = shm::observe_segments();
    // Files of other users take only the places that this user's links leave.
    std::stable_partition(segments.begin(), segments.end(), [](const shm::ObservedSegment& segment) {
        return segment.readability != shm::Readability::foreign;
    });
    for (const auto& segment : segments) {
        if (!wanted_.empty() && wanted_.count(segment.link) == 0) continue;
        if (names.size() < max_links)
            names.insert(segment.link);
        else if (names.count(segment.link) == 0)
            add_cut(state, fmt::format("there are more links than the {} that are read", max_links));
    }
    return names;
}

void StateReader::read_links(const std::set<std::string>& names, const State& before, State& state) {
    std::vector<std::string> order(names.lower_bound(first_), names.end());
    order.insert(order.end(), names.begin(), names.lower_bound(first_));
    first_.clear();
    Round round(stop_, bounds_);
    for (const std::string& name : order) {
        if (!state.links.empty() && round.is_over()) { // a round reads at least one link
            if (first_.empty()) first_ = name;
            keep_link(name, before, state);
            continue;
        }
        try {
            read_link(name, state, round);
        } catch (const shm::Error&) { // the file's name is not a valid link name
        }
    }
    if (!first_.empty())
        add_cut(state, fmt::format(
                           "some links are as in an earlier scan; one scan of all links reads for at most {}",
                           command::format_duration(bounds_.time_ns)));
    std::sort(state.links.begin(), state.links.end(),
              [](const LinkState& a, const LinkState& b) { return a.name < b.name; });
}

/// Notes the links that were requested by name and do not exist, or belong to another user.
void StateReader::check_wanted(State& state) const {
    for (const std::string& wanted : wanted_) {
        const std::string shown = command::replace_nonprintable(wanted);
        const auto found = std::find_if(state.links.begin(), state.links.end(),
                                        [&](const LinkState& link) { return link.name == shown; });
        if (found == state.links.end())
            state.missing_links.push_back(shown);
        else if (found->foreign)
            state.unseen.push_back(fmt::format("link {} belongs to another user", shown));
    }
}

State StateReader::read(const State& before) {
    State state;
    state.time_ms = milliseconds_since_epoch();
    std::set<std::string> names;
    try {
        names = list_links(state);
    } catch (const shm::Error& error) {
        state.error = error.what();
        return state;
    }
    std::erase_if(links_, [&](const auto& link) { return names.count(link.first) == 0; });
    read_links(names, before, state);
    if (stop_ != nullptr && *stop_) return state;
    hosts_.read(state, shm::now_ns());
    ticks_.read(state, shm::now_ns());
    refusals_.read(state, shm::now_ns());
    statuses_.read(state, shm::now_ns());
    check_wanted(state);
    return state;
}

} // namespace tandem::monitor

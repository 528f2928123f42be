// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/state_reader.hpp"

#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"

#include <chrono>

namespace tandem::monitor {
namespace {

std::uint64_t milliseconds_since_epoch() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

} // namespace

void StateReader::read_link(const std::string& name, State& state) {
    auto observation = shm::observe(name);
    const std::uint64_t now_ns = shm::now_ns();
    if (!observation) return; // removed since it was listed
    const auto reader = links_.try_emplace(name, name).first;
    state.links.push_back(reader->second.read(std::move(*observation), now_ns));
}

State StateReader::read() {
    State state;
    state.time_ms = milliseconds_since_epoch();
    std::set<std::string> names;
    try {
        const auto segments = shm::observe_segments();
        // Files of other users take only the places that this user's links leave.
        for (const bool foreign : {false, true})
            for (const auto& segment : segments)
                if (foreign == (segment.readability == shm::Readability::foreign) &&
                    names.size() < max_links && (wanted_.empty() || wanted_.count(segment.link) != 0))
                    names.insert(segment.link);
    } catch (const shm::Error& error) {
        state.error = error.what();
        return state;
    }
    std::erase_if(links_, [&](const auto& link) { return names.count(link.first) == 0; });
    for (const std::string& name : names) {
        try {
            read_link(name, state);
        } catch (const shm::Error&) { // the file's name is not a valid link name
        }
    }
    ticks_.read(state, shm::now_ns());
    refusals_.read(state, shm::now_ns());
    return state;
}

} // namespace tandem::monitor

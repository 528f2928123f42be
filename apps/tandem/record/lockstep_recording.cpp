// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/lockstep_recording.hpp"

#include "shm/inspect/observer.hpp"

#include <fmt/format.h>
#include <tandem_version.hpp>

#include <algorithm>
#include <cstdlib>

namespace tandem::command {
namespace {

std::vector<std::string> links_between(const std::vector<pid_t>& hosts) {
    std::vector<std::string> links;
    for (const auto& segment : shm::observe_segments()) {
        const auto is_host = [&](const shm::ObservedSide& side) {
            return std::find(hosts.begin(), hosts.end(), static_cast<pid_t>(side.pid)) != hosts.end();
        };
        if (segment.readability == shm::Readability::readable && segment.superseded_by == 0 &&
            is_host(segment.sides[0]) && is_host(segment.sides[1]) &&
            std::find(links.begin(), links.end(), segment.link) == links.end())
            links.push_back(segment.link);
    }
    std::sort(links.begin(), links.end());
    return links;
}

} // namespace

LockstepRecording::LockstepRecording(const std::string& file)
    : output_(file,
              {.library = std::string("tandem ") + tandem::version, .compression = mcap::Compression::lz4}) {}

LockstepRecording::~LockstepRecording() = default;

void LockstepRecording::prepare_environment() { setenv("TANDEM_CALL_HISTORY", "1", 1); }

void LockstepRecording::begin(const std::vector<pid_t>& hosts, std::chrono::nanoseconds tick) {
    tick_ = tick;
    output_.writer().add_metadata("tandem.lockstep", {{"tick_ns", std::to_string(tick.count())},
                                                      {"log_time", "simulated time since the first tick"}});
    recorder_ =
        std::make_unique<Recorder>(output_.writer(), links_between(hosts), std::vector<std::string>{});
    recorder_->begin_with_oldest();
    recorder_->set_time(0);
    recorder_->poll(shm::CallActivity::none);
}

void LockstepRecording::record_step(std::uint64_t tick, const std::string& host,
                                    const std::string& component) {
    recorder_->write_step(tick * static_cast<std::uint64_t>(tick_.count()), tick, host, component);
    recorder_->poll(shm::CallActivity::none);
}

void LockstepRecording::close() {
    try {
        if (recorder_) recorder_->write_drops();
    } catch (const mcap::Error& error) {
        output_.end_after(error);
    }
    output_.close();
}

std::string LockstepRecording::summary() const {
    if (!recorder_) return output_.name() + ": nothing was recorded";
    return fmt::format("{}: {} messages of {} ports and {} calls; {} messages and {} calls were overwritten "
                       "before they were copied",
                       output_.name(), recorder_->messages(), recorder_->ports(), recorder_->calls(),
                       recorder_->lost(), recorder_->lost_calls());
}

} // namespace tandem::command

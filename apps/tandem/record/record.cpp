// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/record/commands.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "shm/os/clock.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

namespace tandem::command {
namespace {

/// Pauses between two polls: with and without messages.
constexpr std::chrono::microseconds short_pause{200}, long_pause{1000};
/// Number of polls without a message, and without a call, until the pause becomes long. Messages wait in their ring,
/// but calls only until their slot is reused. Each poll takes CPU time from the hosts.
constexpr int idle_looks = 2, idle_looks_for_calls = 50;

std::atomic<bool> stop_requested = false;

void request_stop(int) { stop_requested = true; }

/// Records until a signal or the end of the duration. Returns the time in s.
double record_messages(const RecordOptions& options, mcap::McapWriter& writer, Recorder& recorder) {
    const std::uint64_t begin = shm::now_ns();
    std::uint64_t flushed = begin;
    const auto seconds = [&](std::uint64_t now) { return static_cast<double>(now - begin) / 1e9; };
    int looks = 0, looks_for_calls = 0;
    for (std::uint64_t now = begin; !stop_requested; now = shm::now_ns()) {
        if (options.duration_s > 0 && seconds(now) >= options.duration_s) break;
        const std::uint64_t calls = recorder.calls();
        looks = recorder.poll(shm::CallActivity::possible, LinkFollower::Rings::likely) ? 0 : looks + 1;
        looks_for_calls = recorder.calls() != calls ? 0 : looks_for_calls + 1;
        if (now - flushed >= flush_interval_ns) {
            recorder.write_drops();
            writer.flush();
            flushed = now;
        }
        const bool busy = looks < idle_looks || looks_for_calls < idle_looks_for_calls;
        std::this_thread::sleep_for(busy ? short_pause : long_pause);
    }
    recorder.set_stop(nullptr);
    recorder.poll();
    recorder.write_drops();
    return seconds(shm::now_ns());
}

} // namespace

int record(const RecordOptions& options) {
    for (const std::string& link : options.links) shm::check_link_name(link); // before creating the file
    const std::string name = recording_file(options, options.links.at(0));
    mcap::FileSink file(name);
    mcap::McapWriter writer(file, writer_options(options));
    Recorder recorder(writer, options.links, options.ports);
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    recorder.set_stop(&stop_requested);
    recorder.poll();
    if (const std::string absent = recorder.absent_links(); !absent.empty())
        print_note("tandem: waiting for link {}; tandem shm list shows existing links\n", absent);
    const double seconds = record_messages(options, writer, recorder);
    writer.close();
    file.close();
    print_text(
        fmt::format("{}: {} messages of {} ports and {} calls in {:.1f} s, {}; {} messages and {} calls were "
                    "overwritten before they were copied\n",
                    name, recorder.messages(), recorder.ports(), recorder.calls(), seconds,
                    format_bytes(writer.bytes_written()), recorder.lost(), recorder.lost_calls()));
    return 0;
}

} // namespace tandem::command

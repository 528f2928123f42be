// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "apps/tandem/record/commands.hpp"
#include "apps/tandem/record/end_signals.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "apps/tandem/record/recording_output.hpp"
#include "shm/os/clock.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>
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
            recorder.write_clock_step();
            writer.flush();
            flushed = now;
        }
        const bool busy = looks < idle_looks || looks_for_calls < idle_looks_for_calls;
        std::this_thread::sleep_for(busy ? short_pause : long_pause);
    }
    recorder.set_stop(nullptr);
    recorder.poll();
    recorder.write_drops();
    recorder.write_clock_step();
    return seconds(shm::now_ns());
}

/// Records to the file, also if it becomes full. Returns the time in s.
double record_to(RecordingOutput& output, const RecordOptions& options, Recorder& recorder) {
    try {
        recorder.set_stop(&stop_requested);
        recorder.poll();
        if (const std::string absent = recorder.absent_links(); !absent.empty())
            print_note("tandem: waiting for link {}; tandem shm list shows existing links\n", absent);
        return record_messages(options, output.writer(), recorder);
    } catch (const mcap::Error& error) {
        output.end_after(error);
    }
}

/// Ends the file. Throws std::runtime_error if a link has not existed. Without any link there is no file.
void end(RecordingOutput& output, const Recorder& recorder) {
    const std::string absent = recorder.absent_links();
    if (recorder.ports() == 0 && recorder.calls() == 0 && !absent.empty()) {
        output.discard();
        throw std::runtime_error(fmt::format(
            "nothing was recorded and {} was not written: link {} did not exist", output.name(), absent));
    }
    output.close();
}

} // namespace

int record(const RecordOptions& options) {
    for (const std::string& link : options.links) shm::check_link_name(link); // before creating the file
    handle_end_signals(request_stop);
    std::signal(SIGPIPE, SIG_IGN); // a gone reader of the output must not end the recording
    RecordingOutput output(recording_file(options, options.links.at(0)), writer_options(options));
    Recorder recorder(output.writer(), options.links, options.ports);
    const double seconds = record_to(output, options, recorder);
    end(output, recorder);
    print_text(fmt::format(
        "{}: {} messages of {} ports and {} calls in {:.1f} s, {}; {} messages and {} calls were "
        "overwritten before they were copied{}\n",
        output.name(), recorder.messages(), recorder.ports(), recorder.calls(), seconds,
        format_bytes(output.writer().bytes_written()), recorder.lost(), recorder.lost_calls(),
        recorder.clock_steps() == 0
            ? ""
            : fmt::format("; the wall clock was set {} times, see {}", recorder.clock_steps(), clock_topic)));
    if (const std::string absent = recorder.absent_links(); !absent.empty())
        throw std::runtime_error(fmt::format("link {} did not exist during the recording", absent));
    return 0;
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/followed_port.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "apps/tandem/record/commands.hpp"
#include "apps/tandem/record/end_signals.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "apps/tandem/record/recording_output.hpp"
#include "host/text/join.hpp"
#include "shm/inspect/observer.hpp"
#include "shm/os/clock.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace tandem::command {
namespace {

/// Pauses between two polls: with and without messages.
constexpr std::chrono::microseconds short_pause{200}, long_pause{1000};
/// Number of polls without a message, and without a call, until the pause becomes long. Messages wait in their ring,
/// but calls only until their slot is reused. Each poll takes CPU time from the hosts.
constexpr int idle_looks = 2, idle_looks_for_calls = 50;

std::atomic<bool> stop_requested = false;

void request_stop(int) { stop_requested = true; }

/// The ports that a recording is limited to and that no link has had so far: misspelt ones, or those of a host that has not
/// started. [one thread]
class AwaitedPorts {
  public:
    /// `links` must outlive this object.
    AwaitedPorts(const std::vector<std::string>& links, const std::vector<std::string>& ports)
        : links_(links), absent_(ports.begin(), ports.end()) {}

    /// Looks at the port tables of all links, unless each port has been found.
    void look();
    bool empty() const { return absent_.empty(); }
    /// Returns the names in quotes, separated by commas.
    std::string names() const;
    /// Returns whether both hosts of each link have published their ports, so that a port of them is known.
    bool all_known() const { return all_known_; }
    /// Describes in one line what does not exist, and what exists.
    std::string describe() const;

  private:
    const std::vector<std::string>& links_;
    std::set<std::string> absent_, known_{};
    bool all_known_ = false;
};

void AwaitedPorts::look() {
    if (absent_.empty()) return;
    known_.clear();
    all_known_ = true;
    for (const std::string& link : links_) {
        const auto observation = shm::observe(link);
        const PortNames found = observation ? find_port_names(*observation) : PortNames();
        if (found.tables < 2) all_known_ = false;
        for (const std::string& name : found.names) {
            known_.insert(name);
            absent_.erase(name);
        }
    }
}

std::string AwaitedPorts::names() const {
    return text::join(absent_, ", ",
                      [](const std::string& name) { return "'" + replace_nonprintable(name) + "'"; });
}

std::string AwaitedPorts::describe() const {
    const std::string known = text::join(known_, ", ", replace_nonprintable);
    return fmt::format("{} {} has no port {}: {}", links_.size() == 1 ? "link" : "none of the links",
                       text::join(links_, ", "), names(),
                       known.empty() ? "tandem graph shows existing ports" : "the ports are " + known);
}

/// Records until a signal or the end of the duration. Returns the time in s.
double record_messages(const RecordOptions& options, mcap::McapWriter& writer, Recorder& recorder,
                       AwaitedPorts& awaited) {
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
            awaited.look();
            flushed = now;
        }
        const bool busy = looks < idle_looks || looks_for_calls < idle_looks_for_calls;
        std::this_thread::sleep_for(busy ? short_pause : long_pause);
    }
    recorder.set_stop(nullptr);
    recorder.poll();
    awaited.look();
    recorder.write_drops();
    recorder.write_clock_step();
    return seconds(shm::now_ns());
}

/// Records to the file, even if it becomes full. Returns the time in s.
double record_to(RecordingOutput& output, const RecordOptions& options, Recorder& recorder,
                 AwaitedPorts& awaited) {
    try {
        recorder.set_stop(&stop_requested);
        recorder.poll();
        if (const std::string absent = recorder.absent_links(); !absent.empty())
            print_note("tandem: waiting for link {}; tandem shm list shows existing links\n", absent);
        else if (!awaited.empty())
            print_note("tandem: waiting for port {}; tandem graph shows existing ports\n", awaited.names());
        return record_messages(options, output.writer(), recorder, awaited);
    } catch (const mcap::Error& error) {
        output.end_after(error);
    }
}

/// Returns which links or ports have not existed; empty if all have.
std::string missing_in(const Recorder& recorder, const AwaitedPorts& awaited) {
    if (const std::string absent = recorder.absent_links(); !absent.empty())
        return fmt::format("link {} did not exist", absent);
    return awaited.empty() ? "" : awaited.describe();
}

/// Ends the file. Throws std::runtime_error if nothing was there to be recorded. There is then no file.
void end(RecordingOutput& output, const Recorder& recorder, const std::string& missing) {
    if (recorder.ports() == 0 && recorder.calls() == 0 && !missing.empty()) {
        output.discard();
        throw std::runtime_error(
            fmt::format("nothing was recorded and {} was not written: {}", output.name(), missing));
    }
    output.close();
}

} // namespace

int record(const RecordOptions& options) {
    for (const std::string& link : options.links) shm::check_link_name(link); // before creating the file
    AwaitedPorts awaited(options.links, options.ports);
    awaited.look();
    if (!awaited.empty() && awaited.all_known()) throw std::runtime_error(awaited.describe());
    handle_end_signals(request_stop);
    std::signal(SIGPIPE, SIG_IGN); // a gone reader of the output must not end the recording
    RecordingOutput output(recording_file(options, options.links.at(0)), writer_options(options));
    Recorder recorder(output.writer(), options.links, options.ports);
    const double seconds = record_to(output, options, recorder, awaited);
    const std::string missing = missing_in(recorder, awaited);
    end(output, recorder, missing);
    print_text(fmt::format(
        "{}: {} messages of {} ports and {} calls in {:.1f} s, {}; {} messages and {} calls were "
        "overwritten before they were copied{}\n",
        output.name(), recorder.messages(), recorder.ports(), recorder.calls(), seconds,
        format_bytes(output.writer().bytes_written()), recorder.lost(), recorder.lost_calls(),
        recorder.clock_steps() == 0
            ? ""
            : fmt::format("; the wall clock was set {} times, see {}", recorder.clock_steps(), clock_topic)));
    if (!recorder.absent_links().empty()) throw std::runtime_error(missing + " during the recording");
    if (!missing.empty()) throw std::runtime_error(missing);
    return 0;
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/bridge_hosts.hpp"

#include "apps/bench/harness/summary.hpp"
#include "apps/bench/measurements/cold.hpp"
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/tandem/bench_host.hpp"
#include "apps/bench/tandem/bridge/floor.hpp"
#include "apps/bench/tandem/bridge/messages.hpp"

#include <cmath>
#include <fstream>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;

/// Also shows both times: the ratio alone does not say whether the machine or the bridge is slow.
void add_ratio_of_tails(Session& session, const std::vector<double>& values) {
    std::vector<double> bridge, ring;
    for (const double value : values) (std::signbit(value) ? ring : bridge).push_back(std::abs(value));
    const Summary through = summarize(std::move(bridge)), floor = summarize(std::move(ring));
    fmt::print(
        stderr,
        "{}: {} messages through the bridge, from the due tick: p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f} ns; "
        "{} over the minimal ring: p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f} ns\n",
        session.bench_case().id(), through.samples, through.p50, through.p99, through.p999, floor.samples,
        floor.p50, floor.p99, floor.p999);
    session.add_result(through.p999 / floor.p999);
}

/// In ns, or ratios of windows.
void read_samples_from(Session& session, const fs::path& file) {
    const std::vector<double> values = doubles_in(file);
    if (is_tail(session)) return add_ratio_of_tails(session, values);
    WindowCounts windows;
    for (const double value : values) {
        const bool dropped = std::isnan(value);
        ++(dropped ? windows.dropped : windows.kept);
        if (!dropped) session.add_result(value);
    }
    if (!is_paired(session)) return;
    windows.floor_ns = median(Floor(floor_file(session), Floor::Role::answers).times());
    finish_windows(session, windows);
}

void make_floor(const Session& session) {
    std::ofstream(floor_file(session)).close();
    fs::resize_file(floor_file(session), Floor::file_bytes(session.bytes() == image_bytes));
}

} // namespace

std::vector<double> doubles_in(const fs::path& file) {
    std::vector<double> values(fs::file_size(file) / sizeof(double));
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

fs::path samples_file(const fs::path& folder) { return folder / "samples"; }

// Not in a folder whose pages the kernel writes to a disk. The file is removed with the case's leftovers.
std::string floor_file(const Session& session) {
    return is_paired(session) ? "/dev/shm/" + session.name() + "-floor" : "";
}

bool has_long_windows(const Session& session) {
    return is_cold(session.bench_case()) && cold_interval_ms(session.bench_case()) >= 100;
}

// A long window takes 0.4 s, and the kernel takes the core from a thread that polls with a priority in every
// second window.
std::size_t paired_windows(const Session& session) {
    return has_long_windows(session) ? 100 : PairedWindows::windows(session.budget());
}

void measure_between_hosts(Session& session, void (*write_files)(const Session&, const fs::path&),
                           const std::vector<std::string>& host_arguments) {
    const fs::path folder = fs::temp_directory_path() / session.name(); // removed with the case's leftovers
    if (session.is_side_a()) {
        fs::create_directory(folder);
        if (is_paired(session)) make_floor(session);
        write_files(session, folder);
    }
    session.arrive_and_wait();
    BenchHost host(session.is_side_a() ? BenchHost::Model::opros : BenchHost::Model::rtm, folder,
                   host_arguments);
    host.wait_for(samples_file(folder).filename());
    if (session.is_side_a()) read_samples_from(session, samples_file(folder));
    session.arrive_and_wait(); // neither side ends the host of the other while it writes
    host.stop();
}

} // namespace tandem::bench

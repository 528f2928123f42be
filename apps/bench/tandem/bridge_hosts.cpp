// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/bridge_hosts.hpp"

#include "apps/bench/measurements/cold.hpp"
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/tandem/bench_host.hpp"
#include "apps/bench/tandem/bridge/floor.hpp"

#include <cmath>
#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Doubles: in ns, or ratios of windows.
void read_samples_from(Session& session, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    WindowCounts windows;
    for (double value = 0; in.read(reinterpret_cast<char*>(&value), sizeof value);) {
        const bool dropped = std::isnan(value);
        ++(dropped ? windows.dropped : windows.kept);
        if (!dropped) session.add_result(value);
    }
    if (is_paired(session)) finish_windows(session, windows);
}

void make_floor(const Session& session) {
    std::ofstream(floor_file(session)).close();
    fs::resize_file(floor_file(session), Floor::file_bytes);
}

} // namespace

fs::path samples_file(const fs::path& folder) { return folder / "samples"; }

// Not in a folder whose pages the kernel writes to a disk. It is removed with the case's leftovers.
std::string floor_file(const Session& session) {
    return is_paired(session) ? "/dev/shm/" + session.name() + "-floor" : "";
}

// With 100 ms between two messages, a window takes 0.8 s.
std::size_t paired_windows(const Session& session) {
    const bool slow = is_cold(session.bench_case()) && cold_interval_ms(session.bench_case()) >= 100;
    return slow ? 24 : PairedWindows::windows(session.budget());
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
    while (!session.stop_requested()) {
        host.require_running();
        if (session.is_side_a() && fs::exists(samples_file(folder))) {
            read_samples_from(session, samples_file(folder));
            session.request_stop();
        }
        std::this_thread::sleep_for(20ms);
    }
    host.stop();
}

} // namespace tandem::bench

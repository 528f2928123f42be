// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/bridge_hosts.hpp"

#include "apps/bench/tandem/bench_host.hpp"

#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Doubles, in ns.
void read_samples_from(Session& session, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    double value = 0;
    while (in.read(reinterpret_cast<char*>(&value), sizeof value)) session.add_result(value);
}

} // namespace

fs::path samples_file(const fs::path& folder) { return folder / "samples"; }

void measure_between_hosts(Session& session, void (*write_files)(const Session&, const fs::path&),
                           const std::vector<std::string>& host_arguments) {
    const fs::path folder = fs::temp_directory_path() / session.name(); // removed with the case's leftovers
    if (session.is_side_a()) {
        fs::create_directory(folder);
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

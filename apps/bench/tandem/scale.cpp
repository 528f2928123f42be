// SPDX-License-Identifier: Apache-2.0
// How the cost of a host grows with the number of its components and their rate. The samples are the lateness
// of the components' cycles. Processor time, times of start and end, memory and number of threads are printed
// with them.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/tandem/bench_host.hpp"
#include "apps/bench/tandem/bridge_hosts.hpp"
#include "apps/bench/tandem/scale/cells.hpp"

#include <charconv>
#include <chrono>
#include <fmt/format.h>
#include <sched.h>
#include <thread>
#include <unistd.h>

namespace tandem::bench {
namespace {

namespace fs = std::filesystem;
using Model = BenchHost::Model;

struct System {
    Model model;
    int components, rate;
    bool data_moves;
};

constexpr double settling_seconds = 0.5;

// Cell i sends to cell i + 1.
void write_rtc_conf(const System& system, const fs::path& folder) {
    std::string names, connections, instances;
    for (int i = 0; i < system.components; ++i) {
        names += "BenchCell,";
        instances += fmt::format("BenchCell{},", i);
        if (i > 0) connections += fmt::format("BenchCell{}.out?port=BenchCell{}.in,", i - 1, i);
    }
    std::ofstream(folder / "rtc.conf")
        << "naming.enable: NO\nlogger.enable: NO\nmanager.shutdown_auto: NO\nexec_cxt.periodic.rate: "
        << system.rate
        << "\nmanager.modules.preload: BenchCellRtc.so\nmanager.components.precreate: " << names
        << "\nmanager.components.preconnect: " << connections
        << "\nmanager.components.preactivation: " << instances << "\n";
}

void write_application(const System& system, const fs::path& folder) {
    std::string components, connections;
    for (int i = 0; i < system.components; ++i) {
        components += component_xml(fmt::format("BenchCell{}", i), "BenchCellComp.xml", {});
        if (i > 0)
            connections += connection_xml("data", fmt::format("BenchCell{}", i - 1), "out",
                                          fmt::format("BenchCell{}", i), "in");
    }
    std::ofstream(folder / "app.xml") << application_xml(components, connections);
    std::ofstream(folder / "BenchCellComp.xml")
        << "<component_profile><name>BenchCellComp</name><execution_environment><library_name>BenchCellComp"
           "</library_name></execution_environment><execution_semantics><type>periodic</type><period>"
        << 1e3 / system.rate << "</period></execution_semantics></component_profile>\n";
}

/// Returns a field of /proc/PID/status, such as `Threads`; memory in KiB.
double status_field(pid_t pid, const std::string& name) {
    std::ifstream file(fmt::format("/proc/{}/status", pid));
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1));
    return 0;
}

/// Returns the processor time that a process has used, in seconds.
double processor_seconds(pid_t pid) {
    std::ifstream file(fmt::format("/proc/{}/stat", pid));
    std::string text;
    std::getline(file, text);
    std::istringstream fields(text.substr(text.rfind(')') + 2)); // the name may contain spaces
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0, system = 0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void sleep_for(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

void run_system(Session& session, const System& system) {
    cpu_set_t all; // the host may use more processors than this process
    CPU_ZERO(&all);
    for (std::size_t i = 0; i < CPU_SETSIZE; ++i) CPU_SET(i, &all);
    sched_setaffinity(0, sizeof all, &all);
    const fs::path folder = fs::temp_directory_path() / session.name(); // removed with the case's leftovers
    fs::create_directory(folder);
    system.model == Model::rtm ? write_rtc_conf(system, folder) : write_application(system, folder);
    setenv(cells_variable,
           fmt::format("{} {} {:d} {}", system.components, 1'000'000'000 / system.rate, system.data_moves,
                       folder.string())
               .c_str(),
           1);
    auto begin = std::chrono::steady_clock::now();
    BenchHost host(system.model, folder);
    host.wait_for("started");
    const double start = seconds_since(begin);
    sleep_for(settling_seconds);
    const double used_before = processor_seconds(host.pid());
    begin = std::chrono::steady_clock::now();
    sleep_for(session.budget().seconds * 2);
    const double used = (processor_seconds(host.pid()) - used_before) / seconds_since(begin);
    const double memory = status_field(host.pid(), "VmRSS") / 1024,
                 threads = status_field(host.pid(), "Threads");
    begin = std::chrono::steady_clock::now();
    host.stop();
    fmt::print(stderr,
               "{}: {:.1f} % of a processor, start {:.2f} s, end {:.2f} s, {:.0f} MB, {:.0f} threads\n",
               session.bench_case().id(), 100 * used, start, seconds_since(begin), memory, threads);
    const auto lateness = doubles_in(samples_file(folder));
    const std::size_t step = lateness.size() / session.budget().samples + 1;
    for (std::size_t i = 0; i < lateness.size(); i += step) session.add_result(lateness[i]);
}

} // namespace

void add_scale_cases(Registry& registry) {
    const auto add = [&](int components, int rate, bool data_moves) {
        for (const Model model : {Model::opros, Model::rtm})
            registry.add({.subject = "scale",
                          .operation = model == Model::opros ? "opros-host" : "rtm-host",
                          .bytes = 4,
                          .wake = Wake::none,
                          .placement = Placement::alone,
                          .detail = fmt::format("{} at {} Hz, {}", components, rate,
                                                data_moves ? "a chain with data" : "idle"),
                          .run = [=](Session& session) {
                              run_system(session, {model, components, rate, data_moves});
                          }});
    };
    for (const int components : {10, 100, 1000})
        for (const int rate : {10, 100, 1000}) {
            if (components * rate > 100'000) continue; // more than the processors of most machines can do
            add(components, rate, false);
            if (rate == 100) add(components, rate, true);
        }
}

} // namespace tandem::bench

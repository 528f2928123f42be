// SPDX-License-Identifier: Apache-2.0
// Component to component across the bridge: A runs opros_host with BenchPing and AdaptorComp, B runs rtm_host
// with BenchPong and InterceptorComp, as a user runs them. Eight doubles each way; both components poll.
// Cold, the sender of the measured direction is periodic and sends once in each tick. The case 64-links has 63 links more in the same
// hosts, of 16 ports each through which nothing goes.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/measurements/cold.hpp"
#include "apps/bench/tandem/bench_host.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

bool is_cold(const Session& session) { return session.bench_case().operation.starts_with("cold-"); }

/// Links beside the measured one.
int idle_links(const Session& session) { return session.bench_case().operation == "64-links" ? 63 : 0; }

std::string idle_link_name(const Session& session, int number) {
    return session.name() + "-" + std::to_string(number);
}

bool opros_sends(const Session& session) { return session.bench_case().detail == "opros-to-rtm"; }

/// The profile of BenchPing: with a period of 1 ms it polls for most of the time.
std::string ping_profile(int period_ms) {
    return fmt::format(
        "<component_profile><name>BenchPing</name>"
        "<execution_environment><library_name>BenchPing.so</library_name></execution_environment>"
        "<execution_semantics><type>periodic</type><period>{}</period><priority>5</"
        "priority><policy>SCHED_FIFO</policy>"
        "</execution_semantics></component_profile>\n",
        period_ms);
}

/// The OPRoS application: BenchPing, connected to the ports that AdaptorComp mirrors.
void write_application_profile(const Session& session, const fs::path& folder) {
    const int interval_ms = is_cold(session) ? cold_interval_ms(session.bench_case()) : 0;
    const std::size_t samples =
        interval_ms > 0 ? cold_messages(session.budget(), interval_ms) : session.budget().samples;
    std::string components =
        component_xml("Ping", "BenchPing.xml", // of this folder
                      {{"file", (folder / "samples").string()},
                       {"direction", session.bench_case().detail},
                       {"samples", std::to_string(samples)},
                       // The number of cold messages counts, and their intervals take what they take.
                       {"seconds", fmt::format("{:g}", interval_ms > 0 ? 60 : session.budget().seconds)},
                       {"cold", interval_ms > 0 ? "yes" : "no"}}) +
        component_xml("Adaptor", "AdaptorComp.xml", {{"link", session.name()}, {"wait", "30"}});
    for (int i = 1; i <= idle_links(session); ++i)
        components += component_xml("Idle" + std::to_string(i), "AdaptorComp.xml",
                                    {{"link", idle_link_name(session, i)}, {"wait", "30"}});
    std::ofstream(folder / "BenchPing.xml")
        << ping_profile(interval_ms > 0 && opros_sends(session) ? interval_ms : 1);
    std::ofstream(folder / "app.xml")
        << application_xml(components, connection_xml("data", "Ping", "ping", "Adaptor", "ping") +
                                           connection_xml("data", "Adaptor", "pong", "Ping", "pong"));
}

/// The RTM side: BenchPong, whose ports InterceptorComp shares over the same link.
void write_rtc_conf(const Session& session, const fs::path& folder) {
    std::string rtcs = "BenchPong, InterceptorComp?link=" + session.name() + "&rtc=BenchPong0";
    for (int i = 0; i < idle_links(session); ++i)
        rtcs += ", BenchIdle, InterceptorComp?link=" + idle_link_name(session, i + 1) + "&rtc=BenchIdle" +
                std::to_string(i);
    std::ofstream(folder / "rtc.conf")
        << rtc_conf_head
        // So many contexts with nothing to do need not run every millisecond.
        << (idle_links(session) > 0 ? "exec_cxt.periodic.rate: 100\n" : "")
        << (is_cold(session) && !opros_sends(session)
                ? fmt::format("exec_cxt.periodic.rate: {}\n", 1000 / cold_interval_ms(session.bench_case()))
                : "")
        // As BenchPing and the cold minimal ring; hot, BenchPong never sleeps and needs none.
        << (is_cold(session) ? "exec_cxt.periodic.priority: 5\n" : "")
        << "manager.modules.preload: BenchPong.so, InterceptorComp.so\n"
        << "manager.components.precreate: " << rtcs << "\n";
}

/// BenchPing's samples: doubles, in ns.
void read_samples_from(Session& session, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    double value = 0;
    while (in.read(reinterpret_cast<char*>(&value), sizeof value)) session.add_result(value);
}

/// Each side starts its host and watches it until BenchPing has written its samples.
void measure_bridge(Session& session) {
    const fs::path folder = fs::temp_directory_path() / session.name(); // removed with the case's leftovers
    if (session.is_side_a()) {
        fs::create_directory(folder);
        write_application_profile(session, folder);
        write_rtc_conf(session, folder);
    }
    session.arrive_and_wait();
    BenchHost host(session.is_side_a() ? BenchHost::Model::opros : BenchHost::Model::rtm, folder);
    while (!session.stop_requested()) {
        host.require_running();
        if (session.is_side_a() && fs::exists(folder / "samples")) {
            read_samples_from(session, folder / "samples");
            session.request_stop();
        }
        std::this_thread::sleep_for(20ms);
    }
    host.stop();
}

} // namespace

void add_bridge_cases(Registry& registry) {
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
        registry.add(
            {.subject = "bridge", .operation = "one-way", .detail = direction, .run = measure_bridge});
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
        registry.add({.subject = "bridge",
                      .operation = "64-links",
                      .extra_seconds = 10,
                      .detail = direction,
                      .run = measure_bridge});
    for (const int interval_ms : cold_intervals_ms)
        for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
            registry.add({.subject = "bridge",
                          .operation = cold_operation(interval_ms),
                          .extra_seconds = 20,
                          .detail = direction,
                          .run = measure_bridge});
}

} // namespace tandem::bench

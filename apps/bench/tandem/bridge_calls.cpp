// SPDX-License-Identifier: Apache-2.0
// Service calls across the bridge, `double add(double, double)`: BenchCallComp in opros_host calls
// BenchCallRtc in rtm_host, or the reverse. The components call without a pause, so with the hosts' default,
// spin-then-futex, caller and worker poll; with `--wait-mode futex` both sleep at once.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/tandem/bench_host.hpp"
#include "apps/bench/tandem/bridge_hosts.hpp"

#include <fmt/format.h>
#include <fstream>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;

using Properties = std::vector<std::pair<std::string, std::string>>;

bool is_asleep(const Session& session) { return session.bench_case().wake == Wake::blocking; }

/// Returns the properties of the answering component: only the floor of a paired case.
Properties answerer_properties(const Session& session) {
    if (!is_paired(session)) return {};
    return {{"floor", floor_file(session)}, {"sleeps", is_asleep(session) ? "yes" : "no"}};
}

Properties caller_properties(const Session& session, const fs::path& folder) {
    Properties properties = answerer_properties(session);
    const bool paired = is_paired(session);
    properties.insert(
        properties.end(),
        {{"file", samples_file(folder).string()},
         {"samples", std::to_string(paired ? paired_windows(session) : session.budget().samples)},
         {"warm_up", std::to_string(paired ? paired_warm_up : 1000)},
         {"seconds", fmt::format("{:g}", paired ? 60 : session.budget().seconds)},
         {"window", is_asleep(session) ? "20" : "200"}});
    return properties;
}

/// Returns the properties as rtc.conf gives them to an RTC.
std::string as_query(const Properties& properties) {
    std::string text;
    for (const auto& [name, value] : properties) text += (text.empty() ? "?" : "&") + name + "=" + value;
    return text;
}

/// Returns the profile of BenchCallComp. In a paired case, a tick of the answering component would take the
/// core from its threads.
std::string call_profile(int period_ms) {
    return fmt::format(
        "<component_profile><name>BenchCallComp</name>"
        "<execution_environment><library_name>BenchCallComp.so</library_name></execution_environment>"
        "<execution_semantics><type>periodic</type><period>{}</period><priority>5</priority>"
        "<policy>SCHED_FIFO</policy></execution_semantics></component_profile>\n",
        period_ms);
}

void write_call_files(const Session& session, const fs::path& folder) {
    const bool opros_calls = opros_to_rtm(session);
    const auto caller = caller_properties(session, folder), answerer = answerer_properties(session);
    std::ofstream(folder / "BenchCallComp.xml") << call_profile(is_paired(session) && !opros_calls ? 100 : 1);
    std::ofstream(folder / "app.xml") << application_xml(
        component_xml("Caller", "BenchCallComp.xml", opros_calls ? caller : answerer) + // of this folder
            component_xml("Adaptor", "AdaptorComp.xml", {{"link", session.name()}, {"wait", "30"}}),
        connection_xml("service", "Caller", "required", "Adaptor", "provided") +
            connection_xml("service", "Adaptor", "required", "Caller", "provided"));
    std::ofstream(folder / "rtc.conf")
        << rtc_conf_head << (is_paired(session) && opros_calls ? "exec_cxt.periodic.rate: 10\n" : "")
        << "manager.modules.preload: BenchCallRtc.so, InterceptorComp.so\n"
        << "manager.components.precreate: BenchCallRtc" << as_query(opros_calls ? answerer : caller)
        << ", InterceptorComp?link=" << session.name() << "&rtc=BenchCallRtc0\n";
}

void measure_bridge_calls(Session& session) {
    std::vector<std::string> arguments;
    if (is_asleep(session)) arguments = {"--wait-mode", "futex"};
    measure_between_hosts(session, write_call_files, arguments);
}

} // namespace

void add_bridge_call_cases(Registry& registry) {
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"}) {
        Case call{.subject = "bridge",
                  .operation = "call",
                  .bytes = 2 * sizeof(double),
                  .wake = Wake::spin_then_futex,
                  .detail = direction,
                  .run = measure_bridge_calls};
        registry.add(call);
        call.wake = Wake::blocking;
        registry.add(call);
        call.power_profile = PowerProfile::low_latency_idle;
        registry.add(call);
        call.operation = "paired-call"; // beside a pair of minimal rings
        call.unit = Unit::ratio;
        registry.add(call);
        call.power_profile = PowerProfile::normal;
        registry.add(call);
        call.wake = Wake::spin_then_futex;
        registry.add(call);
    }
}

} // namespace tandem::bench

// SPDX-License-Identifier: Apache-2.0
// Service calls across the bridge, `double add(double, double)`: BenchCallComp in opros_host calls BenchCallRtc in rtm_host, or
// the other way round. The components call without a pause, so that with the hosts' default, spin-then-futex, caller and worker
// poll; with `--wait-mode futex` both sleep at once.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/tandem/bench_host.hpp"
#include "apps/bench/tandem/bridge_hosts.hpp"

#include <fmt/format.h>
#include <fstream>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;

/// The properties of the component that calls; those of the other one are empty.
std::vector<std::pair<std::string, std::string>> caller_properties(const Session& session,
                                                                   const fs::path& folder) {
    return {{"file", samples_file(folder).string()},
            {"samples", std::to_string(session.budget().samples)},
            {"seconds", fmt::format("{:g}", session.budget().seconds)}};
}

void write_call_files(const Session& session, const fs::path& folder) {
    const auto properties = caller_properties(session, folder);
    const bool opros_calls = opros_to_rtm(session);
    std::ofstream(folder / "app.xml") << application_xml(
        component_xml("Caller", "BenchCallComp.xml", opros_calls ? properties : decltype(properties){}) +
            component_xml("Adaptor", "AdaptorComp.xml", {{"link", session.name()}, {"wait", "30"}}),
        connection_xml("service", "Caller", "required", "Adaptor", "provided") +
            connection_xml("service", "Adaptor", "required", "Caller", "provided"));
    std::string rtc = "BenchCallRtc";
    if (!opros_calls)
        for (char separator = '?'; const auto& [name, value] : properties) {
            rtc += separator + name + "=" + value;
            separator = '&';
        }
    std::ofstream(folder / "rtc.conf")
        << rtc_conf_head << "manager.modules.preload: BenchCallRtc.so, InterceptorComp.so\n"
        << "manager.components.precreate: " << rtc << ", InterceptorComp?link=" << session.name()
        << "&rtc=BenchCallRtc0\n";
}

void measure_bridge_calls(Session& session) {
    std::vector<std::string> arguments;
    if (session.bench_case().wake == Wake::blocking) arguments = {"--wait-mode", "futex"};
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
    }
}

} // namespace tandem::bench

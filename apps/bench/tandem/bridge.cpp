// SPDX-License-Identifier: Apache-2.0
// Component to component across the bridge: A runs opros_host with BenchPing and AdaptorComp, B runs rtm_host
// with BenchPong and InterceptorComp, as a user runs them. Eight doubles go each way: alone, in a structure
// after a string (note), or at the beginning of a picture of 1 MiB, whose filling, sending and reading are
// part of the measured time. Both components poll. In `blocking` cases both are event-driven: an aperiodic
// OPRoS component and a listener of an RTC, each asleep when its message arrives. In cold cases, the sender
// of the measured direction is periodic and sends once in each tick. The case paired-64-links has 63 more
// links in the same hosts, each with 16 unused ports.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/measurements/cold.hpp"
#include "apps/bench/tandem/bench_host.hpp"
#include "apps/bench/tandem/bridge_hosts.hpp"

#include "host/rt/periodic_tick.hpp"

#include <fmt/format.h>
#include <fstream>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;

// A picture of 1 MiB. A note is its string, the eight doubles, a time and their counts as CDR.
constexpr std::size_t note_bytes = 128;

bool is_cold(const Session& session) { return is_cold(session.bench_case()); }

/// Links in addition to the measured one.
int idle_links(const Session& session) {
    return session.bench_case().operation == "paired-64-links" ? 63 : 0;
}

std::string idle_link_name(const Session& session, int number) {
    return session.name() + "-" + std::to_string(number);
}

bool is_event_driven(const Session& session) { return session.bench_case().wake == Wake::blocking; }

/// The type of the ports of BenchPing and BenchPong.
const char* message_name(const Session& session) {
    if (session.bytes() == note_bytes) return "note";
    return session.bytes() == mebibyte ? "image" : "doubles";
}

/// Returns how many messages do not count. A picture takes thousands of times as long as a note.
std::size_t warm_up(const Session& session) {
    if (is_cold(session)) return 5;
    return session.bytes() == mebibyte || is_event_driven(session) ? 100 : 2000;
}

/// Returns the number of messages each way in a window of a paired case; few where each takes long, because a
/// thread that polls at a real-time priority loses its core once a second, for 50 ms.
std::size_t messages_per_half(const Session& session) {
    if (has_long_windows(session)) return 1;
    if (is_cold(session)) return 3;
    if (session.bytes() == mebibyte) return 10;
    return is_event_driven(session) ? 10 : 200;
}

/// Returns what BenchPing measures: a number of times, or ratios of windows.
std::vector<std::pair<std::string, std::string>> amount(const Session& session) {
    if (is_tail(session))
        return {{"samples", std::to_string(2 * session.budget().tail_messages)},
                {"warm_up", "200"},
                {"floor", floor_file(session)},
                {"window", "50"},
                {"origin_ns", std::to_string(rt::grid_origin.count())},
                {"seconds", "3600"}};
    if (is_paired(session)) {
        return {{"samples", std::to_string(paired_windows(session))},
                {"warm_up", std::to_string(paired_warm_up)},
                {"floor", floor_file(session)},
                {"window", std::to_string(messages_per_half(session))},
                {"seconds", "60"}};
    }
    const bool cold = is_cold(session);
    const std::size_t samples = cold ? cold_messages(session.budget(), cold_interval_ms(session.bench_case()))
                                     : session.budget().samples;
    return {{"samples", std::to_string(samples)},
            {"warm_up", std::to_string(warm_up(session))},
            // The number of cold messages counts, however long their intervals take.
            {"seconds", fmt::format("{:g}", cold ? 60 : session.budget().seconds)}};
}

/// Returns the profile of BenchPing: with a period of 1 ms, it polls most of the time.
std::string ping_profile(const char* type, int period_ms) {
    return fmt::format(
        "<component_profile><name>BenchPing</name>"
        "<execution_environment><library_name>BenchPing.so</library_name></execution_environment>"
        "<execution_semantics><type>{}</type><period>{}</period><priority>5</"
        "priority><policy>SCHED_FIFO</policy>"
        "</execution_semantics></component_profile>\n",
        type, period_ms);
}

/// Returns the OPRoS application: BenchPing, connected to the ports that AdaptorComp mirrors.
void write_application_profile(const Session& session, const fs::path& folder) {
    const int interval_ms = is_cold(session) ? cold_interval_ms(session.bench_case()) : 0;
    auto properties = amount(session);
    properties.insert(properties.end(), {{"file", samples_file(folder).string()},
                                         {"direction", session.bench_case().detail},
                                         {"message", message_name(session)},
                                         {"event_driven", is_event_driven(session) ? "yes" : "no"},
                                         {"cold", interval_ms > 0 ? "yes" : "no"}});
    std::string components =
        component_xml("Ping", "BenchPing.xml", properties) + // of this folder
        component_xml("Adaptor", "AdaptorComp.xml", {{"link", session.name()}, {"wait", "30"}});
    for (int i = 1; i <= idle_links(session); ++i)
        components += component_xml("Idle" + std::to_string(i), "AdaptorComp.xml",
                                    {{"link", idle_link_name(session, i)}, {"wait", "30"}});
    std::ofstream(folder / "BenchPing.xml")
        << ping_profile(is_event_driven(session) ? "aperiodic" : "periodic",
                        interval_ms > 0 && opros_to_rtm(session) ? interval_ms : 1);
    std::ofstream(folder / "app.xml")
        << application_xml(components, connection_xml("data", "Ping", "ping", "Adaptor", "ping") +
                                           connection_xml("data", "Adaptor", "pong", "Ping", "pong"));
}

/// Returns the rtc.conf: BenchPong, whose ports InterceptorComp shares over the same link.
void write_rtc_conf(const Session& session, const fs::path& folder) {
    std::string rtcs = std::string("BenchPong?message=") + message_name(session) +
                       "&event_driven=" + (is_event_driven(session) ? "yes" : "no") +
                       (is_paired(session) ? "&floor=" + floor_file(session) : "") +
                       (is_tail(session) ? fmt::format("&origin_ns={}", rt::grid_origin.count()) : "") +
                       ", InterceptorComp?link=" + session.name() + "&rtc=BenchPong0";
    for (int i = 0; i < idle_links(session); ++i)
        rtcs += ", BenchIdle, InterceptorComp?link=" + idle_link_name(session, i + 1) + "&rtc=BenchIdle" +
                std::to_string(i);
    std::ofstream(folder / "rtc.conf")
        << rtc_conf_head
        // Many contexts without work, and contexts of RTCs that only listen, need not run every millisecond.
        << (idle_links(session) > 0 ? "exec_cxt.periodic.rate: 100\n" : "")
        << (is_event_driven(session) ? "exec_cxt.periodic.rate: 10\n" : "")
        << (is_cold(session) && !opros_to_rtm(session)
                ? fmt::format("exec_cxt.periodic.rate: {}\n", 1000 / cold_interval_ms(session.bench_case()))
                : "")
        // The same priority as BenchPing and the cold minimal ring. In hot cases BenchPong never sleeps and
        // needs none.
        << (is_cold(session) ? "exec_cxt.periodic.priority: 5\n" : "")
        << "manager.modules.preload: BenchPong.so, InterceptorComp.so\n"
        << "manager.components.precreate: " << rtcs << "\n";
}

void write_files(const Session& session, const fs::path& folder) {
    write_application_profile(session, folder);
    write_rtc_conf(session, folder);
}

void measure_bridge(Session& session) { measure_between_hosts(session, write_files); }

/// Adds the cases beside the minimal ring between the same two components: polling, a picture, beside 63
/// links, event-driven, and cold. Also adds the tail of one message per millisecond beside that of the
/// minimal ring.
void add_paired_bridge_cases(Registry& registry, const char* direction) {
    Case paired{.subject = "bridge",
                .operation = "paired-one-way",
                .unit = Unit::ratio,
                .extra_seconds = 10,
                .detail = direction,
                .run = measure_bridge};
    registry.add(paired);
    Case picture = paired;
    picture.bytes = mebibyte;
    picture.extra_seconds = 30; // each takes milliseconds on a busy machine
    registry.add(picture);
    Case many_links = paired;
    many_links.operation = "paired-64-links";
    registry.add(many_links);
    paired.wake = Wake::blocking;
    registry.add(paired);
    paired.power_profile = PowerProfile::low_latency_idle;
    registry.add(paired);
    paired.wake = Wake::spin;
    paired.power_profile = PowerProfile::normal;
    paired.extra_seconds = 60;
    for (const int interval_ms : cold_intervals_ms) {
        paired.operation = "paired-" + cold_operation(interval_ms);
        registry.add(paired);
    }
    paired.operation = "tail-" + cold_operation(1);
    registry.add(paired);
}

} // namespace

void add_bridge_cases(Registry& registry) {
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"}) {
        Case one_way{.subject = "bridge", .operation = "one-way", .detail = direction, .run = measure_bridge};
        registry.add(one_way);
        one_way.wake = Wake::blocking;
        registry.add(one_way);
        one_way.power_profile = PowerProfile::low_latency_idle;
        registry.add(one_way);
    }
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
        registry.add({.subject = "bridge",
                      .operation = "note",
                      .bytes = note_bytes,
                      .detail = direction,
                      .run = measure_bridge});
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
        registry.add({.subject = "bridge",
                      .operation = "one-way",
                      .bytes = mebibyte,
                      .extra_seconds = 10, // each takes milliseconds on a busy machine
                      .detail = direction,
                      .run = measure_bridge});
    for (const int interval_ms : cold_intervals_ms)
        for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
            registry.add({.subject = "bridge",
                          .operation = cold_operation(interval_ms),
                          .extra_seconds = 20,
                          .detail = direction,
                          .run = measure_bridge});
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
        add_paired_bridge_cases(registry, direction);
}

} // namespace tandem::bench

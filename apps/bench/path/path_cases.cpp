// SPDX-License-Identifier: Apache-2.0
// The length of each road of a message or a call, in instructions, as a row for each side.
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/machine/cores.hpp"
#include "apps/bench/path/path_hosts.hpp"
#include "apps/bench/path/path_recorder.hpp"

#include <array>
#include <cstring>
#include <thread>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
using Values = std::array<double, 6>;

/// Which side of a road is stepped.
enum class Side { sender, receiver, caller, worker };

const char* name_of(Side side) {
    constexpr const char* names[] = {"sender", "receiver", "caller", "worker"};
    return names[static_cast<int>(side)];
}

void set_result(Session& session, PathTrace trace) {
    session.add_result(trace.counts().instructions);
    session.set_path(trace.counts(), trace.functions());
}

PathTrace record(PathRecorder& recorder, const PathHosts& hosts, Side side) {
    switch (side) {
    case Side::sender:
        return recorder.record_sender();
    case Side::receiver:
        return recorder.record_receiver();
    case Side::caller:
        if (hosts.from() == hosts.to()) return recorder.record_local_call();
        return recorder.record_caller();
    case Side::worker:
        break;
    }
    return recorder.record_worker();
}

void measure_road(Session& session, Road road, Side side) {
    pin_to_all_cores(); // the hosts inherit it, and run as a user runs them
    const bool is_call = side == Side::caller || side == Side::worker;
    const PathHosts hosts(road, is_call, session.name(), fs::temp_directory_path() / session.name());
    Tracer tracer;
    try {
        tracer.attach(hosts.from());
        if (hosts.to() != hosts.from()) tracer.attach(hosts.to());
        PathRecorder recorder(tracer);
        set_result(session, record(recorder, hosts, side));
    } catch (const std::runtime_error& failure) {
        throw std::runtime_error(failure.what() + hosts.first_log_lines());
    }
}

/// [child] Both ends of the minimal ring in one thread, until this process is killed. `traced` becomes 1 when the tracer
/// is there.
[[noreturn]] void run_minimal_ring(std::byte* memory, std::atomic<std::uint32_t>& traced) {
    using Ring = IndexRing<64, 1024, Wake::spin>;
    Ring writer(memory), reader(memory);
    while (traced.load() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    Values sent{}, received{};
    for (;;) {
        sent[0] += 1;
        mark(PathMark::send_begin);
        std::memcpy(writer.claim(), sent.data(), sizeof sent);
        writer.publish();
        mark(PathMark::send_end);
        mark(PathMark::receive_begin);
        std::memcpy(received.data(), reader.wait_for_slot(), sizeof received);
        reader.release();
        mark(received == sent ? PathMark::receive_end : PathMark::nothing);
    }
}

void measure_minimal_ring(Session& session, Side side) {
    auto& traced = *reinterpret_cast<std::atomic<std::uint32_t>*>(session.memory().data());
    ForkedChildren children;
    children.start([&] { run_minimal_ring(session.memory().data() + 4096, traced); });
    Tracer tracer;
    tracer.attach(children.last_pid());
    traced.store(1);
    PathRecorder recorder(tracer);
    set_result(session, side == Side::sender ? recorder.record_sender() : recorder.record_receiver());
}

void add_side(Registry& registry, Group group, const char* road, std::size_t bytes, Side side,
              std::function<void(Session&)> run) {
    registry.add(
        {.group = group,
         .subject = "path",
         .operation = road,
         .bytes = bytes,
         .wake = Wake::none,
         .placement = Placement::alone,
         .unit = Unit::count,
         .extra_seconds = 30, // two hosts start, and thousands of steps take longer on a busy machine
         .detail = name_of(side),
         .run = std::move(run)});
}

void add_road(Registry& registry, const char* name, Road road) {
    const auto add = [&](Side side, std::size_t bytes) {
        add_side(registry, Group::tandem, name, bytes, side,
                 [road, side](Session& session) { measure_road(session, road, side); });
    };
    for (const Side side : {Side::sender, Side::receiver}) add(side, sizeof(Values));
    add(Side::caller, sizeof(double));
    if (road == Road::opros_to_rtm || road == Road::rtm_to_opros) add(Side::worker, sizeof(double));
}

} // namespace

void add_path_cases(Registry& registry) {
#if defined(__x86_64__)
    for (const Side side : {Side::sender, Side::receiver})
        add_side(registry, Group::baseline, "minimal-ring", sizeof(Values), side,
                 [side](Session& session) { measure_minimal_ring(session, side); });
    add_road(registry, "opros-to-rtm", Road::opros_to_rtm);
    add_road(registry, "rtm-to-opros", Road::rtm_to_opros);
    add_road(registry, "inside-opros", Road::inside_opros);
    add_road(registry, "inside-rtm", Road::inside_rtm);
#else
    registry.skipped.push_back({"path", "instructions are counted on x86-64 only"});
#endif
}

} // namespace tandem::bench

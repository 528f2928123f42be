// SPDX-License-Identifier: Apache-2.0
// The length of each path of a message or a call, in instructions, with a row for each side.
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/machine/cores.hpp"
#include "apps/bench/path/path_recorder.hpp"
#include "apps/bench/tandem/bench_host.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>

namespace tandem::bench {
namespace {

/// The path of a message or a call.
enum class Road { opros_to_rtm, rtm_to_opros, inside_opros, inside_rtm };

namespace fs = std::filesystem;

/// A call takes longer if its caller or worker is stepped.
constexpr const char* call_timeout_ms = "20000";

/// The property `role` of the component that performs the operation, and of the other component.
struct Roles {
    std::string from, to;
};

std::string part_xml(const char* name, const std::string& role) {
    return component_xml(name, "BenchPath.xml", {{"role", role}});
}

/// BenchPath and the ports of the RTC behind AdaptorComp, in both directions.
std::string bridged_application(const std::string& role, const std::string& link) {
    return application_xml(
        part_xml("Path", role) +
            component_xml("Adaptor", "AdaptorComp.xml",
                          {{"link", link}, {"wait", "30"}, {"call_timeout", call_timeout_ms}}),
        connection_xml("data", "Path", "out", "Adaptor", "in") +
            connection_xml("data", "Adaptor", "out", "Path", "in") +
            connection_xml("service", "Path", "required", "Adaptor", "provided") +
            connection_xml("service", "Adaptor", "required", "Path", "provided"));
}

std::string local_application(const Roles& roles) {
    return application_xml(part_xml("From", roles.from) + part_xml("To", roles.to),
                           connection_xml("data", "From", "out", "To", "in") +
                               connection_xml("service", "From", "required", "To", "provided"));
}

std::string bridged_rtc_conf(const std::string& role, const std::string& link) {
    return rtc_conf_head + ("manager.modules.preload: BenchPath.so, InterceptorComp.so\n"
                            "manager.components.precreate: BenchPath?role=" +
                            role + ", InterceptorComp?link=" + link +
                            "&rtc=BenchPath0&call_timeout=" + call_timeout_ms + "\n");
}

std::string local_rtc_conf(const Roles& roles) {
    return rtc_conf_head +
           ("manager.modules.preload: BenchPath.so\nmanager.components.precreate: BenchPath?role=" +
            roles.from + ", BenchPath?role=" + roles.to +
            "\nmanager.components.preconnect: BenchPath0.out?port=BenchPath1.in&interface_type=direct, "
            "BenchPath0.required?port=BenchPath1.provided\n"
            "manager.components.preactivation: BenchPath0, BenchPath1\n");
}

/// The hosts of a path, each with a component BenchPath. `from` performs the operation and `to` takes part;
/// within one host, both are the same process.
class PathHosts {
  public:
    /// Writes the profiles into the folder and starts the hosts. `link`: the name of the link between the
    /// hosts. The operation is a call, or a message of 6 doubles. Throws std::system_error.
    PathHosts(Road road, bool is_call, const std::string& link, const fs::path& folder) : road_(road) {
        const Roles roles = is_call ? Roles{"call", "serve"} : Roles{"send", "receive"};
        const bool from_opros = road == Road::opros_to_rtm;
        fs::create_directory(folder); // removed with the case's leftovers
        if (road != Road::inside_rtm) {
            std::ofstream(folder / "app.xml")
                << (road == Road::inside_opros
                        ? local_application(roles)
                        : bridged_application(from_opros ? roles.from : roles.to, link));
            opros_.emplace(BenchHost::Model::opros, folder);
        }
        if (road != Road::inside_opros) {
            std::ofstream(folder / "rtc.conf")
                << (road == Road::inside_rtm ? local_rtc_conf(roles)
                                             : bridged_rtc_conf(from_opros ? roles.to : roles.from, link));
            rtm_.emplace(BenchHost::Model::rtm, folder);
        }
    }

    pid_t from() const { return road_ == Road::rtm_to_opros || !opros_ ? rtm_->pid() : opros_->pid(); }
    pid_t to() const { return road_ == Road::rtm_to_opros || !rtm_ ? opros_->pid() : rtm_->pid(); }
    /// Returns the first log lines of each host, for an error message.
    std::string first_log_lines() const {
        std::string out;
        for (const auto* host : {&opros_, &rtm_})
            if (*host) out += "; " + (*host)->first_log_line();
        return out;
    }

  private:
    Road road_;
    std::optional<BenchHost> opros_, rtm_;
};

namespace fs = std::filesystem;
using Values = std::array<double, 6>;

/// The stepped side of a path.
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
    pin_to_all_cores(); // the hosts inherit it, and run as a user would run them
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

/// [child] Runs both ends of the minimal ring in one thread until this process is killed. `traced` becomes 1
/// when the tracer is attached.
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
    for (const Side side : {Side::sender, Side::receiver})
        add_side(registry, Group::baseline, "minimal-ring", sizeof(Values), side,
                 [side](Session& session) { measure_minimal_ring(session, side); });
    add_road(registry, "opros-to-rtm", Road::opros_to_rtm);
    add_road(registry, "rtm-to-opros", Road::rtm_to_opros);
    add_road(registry, "inside-opros", Road::inside_opros);
    add_road(registry, "inside-rtm", Road::inside_rtm);
}

} // namespace tandem::bench

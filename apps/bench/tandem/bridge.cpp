// SPDX-License-Identifier: Apache-2.0
// Component to component across the bridge: A runs opros_host with BenchPing and AdaptorComp, B runs rtm_host
// with BenchPong and InterceptorComp, as a user runs them. Eight doubles each way; both components poll.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"

#include "host/process/child_process.hpp"

#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// An element of an OPRoS application profile, for ports of the same name.
std::string connection(const char* from, const char* to, const char* port) {
    return fmt::format(
        "<port_connection port_type=\"data\"><source component_name=\"{0}\" port_name=\"{2}\"/>"
        "<target component_name=\"{1}\" port_name=\"{2}\"/></port_connection>\n",
        from, to, port);
}

/// The OPRoS application: BenchPing, connected to the ports that AdaptorComp mirrors.
void write_application_profile(const Session& session, const fs::path& folder) {
    const auto property = [](const char* name, const std::string& value) {
        return fmt::format("<property name=\"{}\">{}</property>", name, value);
    };
    std::ofstream(folder / "app.xml")
        << "<?xml version=\"1.0\"?>\n<package_profile><name>bench</name>\n<subcomponents>\n"
        << "<subcomponent><name>Ping</name><reference>BenchPing.xml</reference><properties>"
        << property("file", (folder / "samples").string())
        << property("direction", session.bench_case().detail)
        << property("samples", std::to_string(session.budget().samples))
        << property("seconds", fmt::format("{:g}", session.budget().seconds))
        << "</properties></subcomponent>\n<subcomponent><name>Adaptor</name><reference>AdaptorComp.xml</"
           "reference>"
        << "<properties>" << property("link", session.name()) << property("wait", "30")
        << "</properties></subcomponent>\n</subcomponents>\n<port_connections>\n"
        << connection("Ping", "Adaptor", "ping") << connection("Adaptor", "Ping", "pong")
        << "</port_connections></package_profile>\n";
}

/// The RTM side: BenchPong, whose ports InterceptorComp shares over the same link.
void write_rtc_conf(const Session& session, const fs::path& folder) {
    std::ofstream(folder / "rtc.conf")
        << "naming.enable: NO\nlogger.enable: NO\nmanager.shutdown_auto: NO\nexec_cxt.periodic.rate: 1000\n"
        << "manager.modules.preload: BenchPong.so, InterceptorComp.so\n"
        << "manager.components.precreate: BenchPong, InterceptorComp?link=" << session.name()
        << "&rtc=BenchPong0\n";
}

/// The hosts are in the folder of this program. --parent-death: they end if this side is killed.
std::vector<std::string> host_command(const Session& session, const fs::path& folder) {
    const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
    if (session.is_side_a())
        return {(programs / "opros_host").string(), (folder / "app.xml").string(), "--strict",
                "--parent-death"};
    return {(programs / "rtm_host").string(), "-f", (folder / "rtc.conf").string(), "--parent-death"};
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
    const fs::path log = folder / (session.is_side_a() ? "opros.log" : "rtm.log");
    const process::FileDescriptor out(open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
    process::ChildProcess host(host_command(session, folder), {-1, out.get(), out.get(), ""});
    while (!session.stop_requested()) {
        if (host.poll()) { // the first line of its log says why
            std::string line;
            std::getline(std::ifstream(log), line);
            throw std::runtime_error(fmt::format("{} {}: {}", session.is_side_a() ? "opros_host" : "rtm_host",
                                                 host.poll()->text(), line));
        }
        if (session.is_side_a() && fs::exists(folder / "samples")) {
            read_samples_from(session, folder / "samples");
            session.request_stop();
        }
        std::this_thread::sleep_for(20ms);
    }
    host.stop(5s);
}

} // namespace

void add_bridge_cases(Registry& registry) {
    for (const char* direction : {"opros-to-rtm", "rtm-to-opros"})
        registry.add(
            {.subject = "bridge", .operation = "one-way", .detail = direction, .run = measure_bridge});
}

} // namespace tandem::bench

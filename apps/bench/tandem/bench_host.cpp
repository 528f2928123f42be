// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/bench_host.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <poll.h>
#include <sys/inotify.h>
#include <system_error>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const char* name_of(BenchHost::Model model) {
    return model == BenchHost::Model::opros ? "opros_host" : "rtm_host";
}

/// The hosts are in the folder of this program. --parent-death: they end if this process is killed.
std::vector<std::string> command(BenchHost::Model model, const fs::path& folder) {
    const std::string program = fs::read_symlink("/proc/self/exe").parent_path() / name_of(model);
    if (model == BenchHost::Model::opros)
        return {program, (folder / "app.xml").string(), "--strict", "--parent-death"};
    return {program, "-f", (folder / "rtc.conf").string(), "--parent-death"};
}

process::ChildProcess start(BenchHost::Model model, const fs::path& folder, const fs::path& log,
                            const std::vector<std::string>& arguments) {
    const process::FileDescriptor out(open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
    auto line = command(model, folder);
    line.insert(line.end(), arguments.begin(), arguments.end());
    return process::ChildProcess(line, {-1, out.get(), out.get(), ""});
}

} // namespace

const char* const rtc_conf_head =
    "naming.enable: NO\nlogger.enable: NO\nmanager.shutdown_auto: NO\nexec_cxt.periodic.rate: 1000\n";

BenchHost::BenchHost(Model model, const fs::path& folder, const std::vector<std::string>& arguments)
    : name_(name_of(model)), folder_(folder),
      log_(folder / (model == Model::opros ? "opros.log" : "rtm.log")),
      process_(start(model, folder, log_, arguments)) {}

std::string BenchHost::first_log_line() const {
    std::string line;
    std::ifstream file(log_);
    std::getline(file, line);
    return name_ + ": " + line;
}

void BenchHost::require_running() {
    if (const auto& ended = process_.poll())
        throw std::runtime_error(fmt::format("{} ({})", first_log_line(), ended->text()));
}

void BenchHost::wait_for(const std::string& file) {
    const process::FileDescriptor events(inotify_init1(IN_CLOEXEC | IN_NONBLOCK));
    if (!events || inotify_add_watch(events.get(), folder_.c_str(), IN_MOVED_TO) < 0)
        throw std::system_error(errno, std::generic_category(), "cannot watch " + folder_.string());
    while (!fs::exists(folder_ / file)) {
        require_running();
        pollfd changes[] = {{events.get(), POLLIN, 0}, {process_.pidfd(), POLLIN, 0}};
        if (::poll(changes, std::size(changes), -1) < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "poll");
        char event[4096];
        while (read(events.get(), event, sizeof event) > 0) {
        }
    }
}

void BenchHost::stop() { process_.stop(5s); }

std::string connection_xml(const char* type, const std::string& from, const std::string& from_port,
                           const std::string& to, const std::string& to_port) {
    return fmt::format("<port_connection port_type=\"{}\"><source component_name=\"{}\" port_name=\"{}\"/>"
                       "<target component_name=\"{}\" port_name=\"{}\"/></port_connection>\n",
                       type, from, from_port, to, to_port);
}

std::string component_xml(const std::string& name, const std::string& reference,
                          const std::vector<std::pair<std::string, std::string>>& properties) {
    std::string out =
        fmt::format("<subcomponent><name>{}</name><reference>{}</reference><properties>", name, reference);
    for (const auto& [key, value] : properties)
        out += fmt::format("<property name=\"{}\">{}</property>", key, value);
    return out + "</properties></subcomponent>\n";
}

std::string application_xml(const std::string& components, const std::string& connections) {
    return "<?xml version=\"1.0\"?>\n<package_profile><name>bench</name>\n<subcomponents>\n" + components +
           "</subcomponents>\n<port_connections>\n" + connections + "</port_connections></package_profile>\n";
}

} // namespace tandem::bench

// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/run_directory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "apps/wheelchair/run/topology.hpp"
#include "host/process/output_file.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

namespace fs = std::filesystem;

namespace {

fs::path temporary_folder(const char* name) {
    std::string pattern = (fs::temp_directory_path() / name).string() + "-XXXXXX";
    if (!mkdtemp(pattern.data()))
        throw InputError(pattern + ": cannot be created: " + std::strerror(errno) +
                         "; set TMPDIR to a writable folder");
    return pattern;
}

constexpr const char* marker_file = "wheelchair-run"; // an empty file in each folder that a run created

/// Prepares the folder to keep. Removes an earlier run in it, because components append to existing trace
/// files. Refuses a folder with other contents: this program never deletes user files.
fs::path kept_folder(const fs::path& path) {
    std::error_code error;
    const bool is_run_folder = fs::exists(path / marker_file);
    if (!is_run_folder && fs::exists(path) && !fs::is_empty(path, error))
        throw InputError(path.string() +
                         ": contains files that are not from an earlier run; give an empty or a new folder");
    for (const char* part : {"opros", "rtm", "trace", "log"}) fs::remove_all(path / part, error);
    fs::create_directories(path, error);
    if (error) throw InputError(path.string() + ": cannot be created: " + error.message());
    process::write_output(path / marker_file, "");
    return path;
}

fs::path run_folder(const Options& options, Configuration configuration) {
    if (options.keep.empty()) return temporary_folder("tandem-wheelchair");
    return kept_folder(options.compare ? fs::path(options.keep) / name_of(configuration)
                                       : fs::path(options.keep));
}

// Escapes a text for an XML element.
std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else
            out += c;
    }
    return out;
}

using Parameters = std::vector<std::pair<std::string, std::string>>;

Parameters adaptor_parameters(const std::string& link, const Options& o) {
    return {{"link", link}, {"wait", fmt::format("{:g}", o.host_wait)}};
}

// Each component gets the scenario's name, so that all three use the same scenario.
Parameters parameters_of(const std::string& member, const Options& o, const fs::path& run) {
    Parameters p{{"scenario", load_scenario(o.scenario, o.joystick_file).name},
                 {"joystick_file", o.joystick_file},
                 {"clock", o.lockstep ? "simulated" : "monotonic"},
                 {"trace", (run / "trace" / (member + ".trace")).string()}};
    if (member == "ControlComp") p.emplace_back("poll_us", o.lockstep ? "0" : fmt::format("{:g}", o.poll_us));
    return p;
}

// AdaptorComp runs once per link, with the name of the link's adaptor.
std::string component_profile(const std::string& member) {
    return member.ends_with("Adaptor") ? "AdaptorComp.xml" : member + ".xml";
}

// Returns a component of the OPRoS application profile.
std::string subcomponent(const RunComponent& member, const Parameters& parameters) {
    std::string xml = fmt::format(
        "    <subcomponent type=\"atomic\">\n      <name>{}</name>\n      <reference>{}</reference>\n"
        "      <properties>\n",
        member.name, component_profile(member.name));
    for (const auto& [name, value] : parameters)
        xml += fmt::format("        <property name=\"{}\">{}</property>\n", name, escaped(value));
    return xml + "      </properties>\n    </subcomponent>\n";
}

std::string port_connection(const Connection& w) {
    return fmt::format("    <port_connection port_type=\"{}\">\n"
                       "      <source component_name=\"{}\" port_name=\"{}\"/>\n"
                       "      <target component_name=\"{}\" port_name=\"{}\"/>\n    </port_connection>\n",
                       w.kind == Connection::data ? "data" : "service", w.from, w.from_port, w.to, w.to_port);
}

// Returns a setting of rtc.conf; "" if the list is empty.
std::string list_setting(const char* key, const std::vector<std::string>& values) {
    return values.empty() ? "" : fmt::format("{}: {}\n", key, fmt::join(values, ", "));
}

// Only this program ends the host, and RTCs are not published, so that two runs can proceed at the same time.
constexpr const char* rtc_conf_head =
    "# Settings of rtm_host for one wheelchair run. No name service: the RTCs find each other in this "
    "process.\n"
    "naming.enable: NO\nlogger.log_level: WARN\nmanager.shutdown_auto: NO\nmanager.shutdown_on_nortcs: NO\n"
    "exec_cxt.periodic.rate: 100\n";

} // namespace

fs::path program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

Folder::~Folder() {
    std::error_code ignored; // a failed removal must not hide the run's result
    if (!keep_) fs::remove_all(path_, ignored);
}

RunDirectory::RunDirectory(const Options& options, Configuration configuration, const fs::path& programs)
    : folder_(run_folder(options, configuration), !options.keep.empty()),
      sockets_(temporary_folder("tandem-step"), false) {
    // The process id makes link names unique among simultaneous runs on this machine.
    for (const Bridge& bridge : bridges(configuration))
        links_[bridge.adaptor] = fmt::format("wheelchair-{}{}", getpid(), bridge.link_suffix);
    for (const char* part : {"trace", "log"}) fs::create_directories(path() / part);
    if (!opros_components(configuration).empty()) {
        write_opros(options, configuration);
        add_host(options, "opros_host", programs,
                 {(path() / "opros" / "wheelchair.xml").string(), "--strict"});
    }
    if (!rtm_components(configuration).empty()) {
        write_rtm(options, configuration);
        add_host(options, "rtm_host", programs, {"-f", (path() / "rtm" / "rtc.conf").string()});
    }
}

std::string RunDirectory::chair_link() const { return fmt::format("wheelchair-{}-chair", getpid()); }

std::string RunDirectory::step_socket(const std::string& host) const {
    return (sockets_.path() / host).string();
}

void RunDirectory::add_host(const Options& options, const std::string& name, const fs::path& programs,
                            const std::vector<std::string>& profile) {
    HostCommand host{name, {(programs / name).string()}, (path() / "log" / (name + ".log")).string()};
    auto& c = host.command;
    c.insert(c.end(), profile.begin(), profile.end());
    c.push_back("--parent-death"); // so that no host outlives this program
    if (options.lockstep) c.insert(c.end(), {"--lockstep", step_socket(name)});
    const int cpu = name == "opros_host" ? options.opros_cpu : options.rtm_cpu;
    if (cpu >= 0) c.insert(c.end(), {"--cpu", std::to_string(cpu)});
    c.insert(c.end(), options.host_arguments.begin(), options.host_arguments.end());
    // The host already tried its libraries before it became ready. Trying them takes half of the time of a restart.
    host.restart_arguments = {"--no-probe"};
    hosts_.push_back(std::move(host));
}

void RunDirectory::write_opros(const Options& options, Configuration configuration) {
    fs::create_directories(path() / "opros");
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<package_profile>\n  <name>wheelchair</name>\n"
        "  <!-- The component listed last starts first. -->\n  <subcomponents>\n";
    const auto members = opros_components(configuration);
    for (auto m = members.rbegin(); m != members.rend(); ++m)
        xml += subcomponent(*m, links_.count(m->name) ? adaptor_parameters(links_.at(m->name), options)
                                                      : parameters_of(m->name, options, path()));
    xml += "  </subcomponents>\n  <port_connections>\n";
    for (const auto& wire : opros_connections(configuration)) xml += port_connection(wire);
    process::write_output(path() / "opros" / "wheelchair.xml",
                          xml + "  </port_connections>\n</package_profile>\n");
}

void RunDirectory::write_rtm(const Options& options, Configuration configuration) {
    fs::create_directories(path() / "rtm");
    std::vector<std::string> modules, create, activate, connect;
    std::string files;
    for (const auto& member : rtm_components(configuration)) {
        std::string conf;
        for (const auto& [name, value] : parameters_of(member.name, options, path()))
            conf += fmt::format("conf.default.{}: {}\n", name, value);
        const auto file = path() / "rtm" / (member.name + "0.conf");
        conf += fmt::format("exec_cxt.periodic.rate: 100\nexec_cxt.periodic.phase: {:g}\n"
                            "exec_cxt.periodic.priority: {}\n",
                            member.phase_ms, member.priority);
        process::write_output(file, conf);
        files += fmt::format("wheelchair.{}0.config_file: {}\n", member.name, file.string());
        modules.push_back(member.name + ".so");
        create.push_back(member.name);
        activate.push_back(member.name + "0");
    }
    for (const auto& w : rtm_connections(configuration))
        connect.push_back(fmt::format("{}0.{}?port={}0.{}", w.from, w.from_port, w.to, w.to_port));
    if (!links_.empty()) {
        modules.push_back("InterceptorComp.so");
        activate.clear(); // each InterceptorComp activates its RTC and itself when its AdaptorComp starts
    }
    for (const Bridge& bridge : bridges(configuration))
        create.push_back(
            fmt::format("InterceptorComp?link={}&rtc={}", links_.at(bridge.adaptor), bridge.rtc));
    std::string conf = rtc_conf_head + files;
    conf += list_setting("manager.modules.preload", modules) +
            list_setting("manager.components.precreate", create) +
            list_setting("manager.components.preconnect", connect) +
            list_setting("manager.components.preactivation", activate);
    process::write_output(path() / "rtm" / "rtc.conf", conf);
}

} // namespace tandem::wheelchair

// SPDX-License-Identifier: Apache-2.0
// A folder with an OPRoS application and an rtc.conf, and hosts started on them.
#pragma once

#include "host/process/child_process.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/// A port of 127.0.0.1 that nobody listens at.
inline std::string unused_port() {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(fd, reinterpret_cast<sockaddr*>(&address), size) != 0)
        throw std::runtime_error("no port is free");
    getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
    close(fd);
    return std::to_string(ntohs(address.sin_port));
}

/// The files of a bridge between TalkerComp and EchoRtc0; texts may be changed before they are used.
class TwoHosts {
  public:
    TwoHosts() {
        std::string name = (std::filesystem::temp_directory_path() / "tandem-bridge-XXXXXX").string();
        folder_ = mkdtemp(name.data());
        link_ = folder_.filename().string();
        for (const char* profile : {"TalkerComp.xml", "AlarmComp.xml", "CookComp.xml", "CameraComp.xml",
                                    "SurveyComp.xml", "MatrixComp.xml", "ServiceMatrixComp.xml"})
            std::filesystem::copy_file(std::string(TEST_SOURCES "/opros/") + profile, folder_ / profile);
        connections_ = connection("data", "Talker", "word", "Adaptor", "word") +
                       connection("data", "Adaptor", "reply", "Talker", "reply") +
                       connection("service", "Talker", "dictionary", "Adaptor", "dictionary");
    }
    ~TwoHosts() {
        for (auto& [name, host] : hosts_) host.stop(std::chrono::seconds(30));
        std::filesystem::remove_all(folder_);
    }
    TwoHosts(const TwoHosts&) = delete;
    TwoHosts& operator=(const TwoHosts&) = delete;

    static std::string connection(const std::string& type, const std::string& from,
                                  const std::string& from_port, const std::string& to,
                                  const std::string& to_port) {
        return "<port_connection port_type=\"" + type + "\"><source component_name=\"" + from +
               "\" port_name=\"" + from_port + "\"/><target component_name=\"" + to + "\" port_name=\"" +
               to_port + "\"/></port_connection>\n";
    }
    void set_connections(const std::string& xml) { connections_ = xml; }
    /// The OPRoS component that is there as Talker.
    void set_talker(const std::string& component) { talker_ = component; }
    void set_talker_properties(const std::string& xml) { talker_properties_ = xml; }
    /// The RTC behind the bridge.
    void set_rtc(const std::string& rtc) {
        rtc_ = rtc;
        set_interceptor("rtc=" + rtc + "0");
    }
    /// Properties of that RTC, as in `slow_ms=100`.
    void set_rtc_properties(const std::string& properties) { rtc_properties_ = "?" + properties; }
    void set_large_kib(const std::string& of_adaptor) { large_kib_ = of_adaptor; }
    /// Whether one refused connection ends the OPRoS host.
    void set_strict(bool strict) { strict_ = strict; }
    /// More properties of AdaptorComp.
    void set_adaptor_property(const std::string& name, const std::string& value) {
        adaptor_properties_ += "<property name=\"" + name + "\">" + value + "</property>";
    }
    void set_wait(const std::string& seconds) { wait_ = seconds; }
    void set_interceptor(const std::string& parameters) { interceptor_ = parameters; }
    void append_to_rtc_conf(const std::string& lines) { rtc_conf_more_ += lines; }
    /// One more OPRoS component, whose profile is in opros/; `properties` as an application profile has them.
    void add_component(const std::string& name, const std::string& type, const std::string& properties = "") {
        std::filesystem::copy_file(TEST_SOURCES "/opros/" + type + ".xml", folder_ / (type + ".xml"),
                                   std::filesystem::copy_options::skip_existing);
        components_ += "<subcomponent><name>" + name + "</name><reference>" + type +
                       ".xml</reference><properties>" + properties + "</properties></subcomponent>\n";
    }
    static std::string property(const std::string& name, const std::string& value) {
        return "<property name=\"" + name + "\">" + value + "</property>";
    }
    void set_adaptor_properties(const std::string& xml) { adaptor_properties_ = xml; }
    /// Neither a Talker nor an RTC: the link has components of add_component() only.
    void leave_out_talker_and_rtc() {
        talker_.clear();
        connections_.clear();
        interceptor_.clear();
    }
    /// One more RTC, created after the others.
    void add_rtc(const std::string& type) {
        rtc_properties_ += ", " + type;
        if (type != rtc_) modules_ += type + ".so, ";
    }
    /// One more RTC, of a type that rtm_host has itself, created after the others.
    void add_built_in_rtc(const std::string& arguments) { rtc_properties_ += ", " + arguments; }
    /// One more link, with an AdaptorComp of that name, for the RTC of that name.
    void add_link(const std::string& adaptor, const std::string& rtc) {
        const std::string link = link_ + "-" + std::to_string(++more_links_ + 1);
        components_ += "<subcomponent><name>" + adaptor +
                       "</name><reference>AdaptorComp.xml</reference><properties>" + property("link", link) +
                       "</properties></subcomponent>\n";
        more_interceptors_ += ", InterceptorComp?link=" + link + "&rtc=" + rtc;
    }
    /// A third host, with an rtc.conf of these lines.
    void start_another_rtm(const std::string& port, const std::string& lines) {
        std::ofstream(folder_ / "other.conf")
            << "naming.enable: NO\nlogger.enable: NO\nmanager.shutdown_auto: NO\n"
            << lines;
        start("other", {RTM_HOST, "-f", (folder_ / "other.conf").string(), "-p", port});
    }
    /// rtm_host's manager is at this port of 127.0.0.1.
    void set_manager_port(const std::string& port) { manager_port_ = port; }
    /// More arguments of both hosts.
    void set_switches(const std::vector<std::string>& switches) { switches_ = switches; }
    const std::string& link() const { return link_; }

    /// Returns the application's profile.
    std::filesystem::path write_application() const {
        std::ofstream(folder_ / "app.xml")
            << "<?xml version=\"1.0\"?>\n<package_profile><name>app</name>\n<subcomponents>\n"
            << (talker_.empty() ? ""
                                : "<subcomponent><name>Talker</name><reference>" + talker_ +
                                      ".xml</reference><properties>" + talker_properties_ +
                                      "</properties></subcomponent>\n")
            << components_
            << "<subcomponent><name>Adaptor</name><reference>AdaptorComp.xml</reference><properties>"
            << "<property name=\"link\">" << link_ << "</property><property name=\"wait\">" << wait_
            << "</property><property name=\"large_kib\">" << large_kib_ << "</property>"
            << adaptor_properties_ << "</properties></subcomponent>\n</subcomponents>\n<port_connections>\n"
            << connections_ << "</port_connections></package_profile>\n";
        std::filesystem::copy_file(
            std::filesystem::path(OPROS_HOST).parent_path() / "../plugins/opros/AdaptorComp.xml",
            folder_ / "AdaptorComp.xml", std::filesystem::copy_options::overwrite_existing);
        return folder_ / "app.xml";
    }
    void start_opros() {
        std::vector<std::string> command{OPROS_HOST, write_application().string()};
        if (strict_) command.push_back("--strict");
        start("opros", command);
    }
    /// Runs `tandem opros check` on the application. Returns its exit code and what it printed.
    std::pair<int, std::string> check_application(const std::vector<std::string>& arguments = {}) const {
        const auto log = folder_ / "check.log";
        std::string command = "TANDEM_PLUGIN_PATH=" TEST_PLUGINS " " TANDEM_PROGRAM " opros check " +
                              write_application().string();
        for (const auto& argument : arguments) command += " " + argument;
        command += " > " + log.string() + " 2>&1";
        const int status = std::system(command.c_str());
        std::ifstream file(log);
        return {WEXITSTATUS(status), {std::istreambuf_iterator<char>(file), {}}};
    }
    const std::filesystem::path& folder() const { return folder_; }
    void write_rtc_conf() const {
        const bool has_rtc = !interceptor_.empty();
        std::ofstream(folder_ / "rtc.conf")
            << "naming.enable: NO\nlogger.enable: NO\nmanager.shutdown_auto: NO\nexec_cxt.periodic.rate: "
               "100\n"
            << "manager.modules.preload: " << rtc_ << ".so, " << modules_ << "InterceptorComp.so\n"
            << "manager.components.precreate: " << (has_rtc ? rtc_ + rtc_properties_ + ", " : "")
            << "InterceptorComp?link=" << link_ << (has_rtc ? "&" + interceptor_ : "") << more_interceptors_
            << "\n"
            << rtc_conf_more_;
    }
    void start_rtm() {
        write_rtc_conf();
        std::vector<std::string> command{RTM_HOST, "-f", (folder_ / "rtc.conf").string()};
        if (!manager_port_.empty()) command.insert(command.end(), {"-p", manager_port_});
        start("rtm", command);
    }

    /// Everything a host has written so far.
    std::string output(const std::string& host) const {
        std::ifstream file(folder_ / (host + ".log"));
        return {std::istreambuf_iterator<char>(file), {}};
    }
    bool says(const std::string& host, const std::string& text, std::size_t from = 0) const {
        for (int i = 0; i < 1500; ++i) {
            if (output(host).find(text, from) != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return false;
    }
    /// Exit code of a host that ends by itself; -1 if it does not within a bound that is out of proportion.
    int exit_code(const std::string& host) {
        const auto& ended = hosts_.at(host).wait(std::chrono::seconds(60));
        return ended && !ended->signalled ? ended->code : -1;
    }
    bool runs(const std::string& host) { return !hosts_.at(host).poll(); }
    int stop(const std::string& host) {
        const auto& ended = hosts_.at(host).stop(std::chrono::seconds(30));
        return ended && !ended->signalled ? ended->code : -1;
    }
    /// Asks both hosts to end at the same time. True if both have ended in order.
    bool stop_both() {
        for (const auto& [name, host] : hosts_) ::kill(host.pid(), SIGTERM);
        const int opros = exit_code("opros"), rtm = exit_code("rtm");
        return opros == 0 && rtm == 0;
    }
    void kill(const std::string& host) {
        ::kill(hosts_.at(host).pid(), SIGKILL);
        hosts_.at(host).wait(std::chrono::seconds(30));
        hosts_.erase(host);
    }
    /// Kills rtm_host, waits until opros_host has noticed, and starts it again. Where the new output of `host` begins.
    std::size_t restart_rtm(const std::string& host) {
        kill("rtm");
        if (!says("opros", "is down: the peer process has gone"))
            throw std::runtime_error("opros_host has not noticed a death");
        const std::size_t before = output(host).size();
        start_rtm();
        return before;
    }
    /// Stops a host by SIGSTOP; returns when each of its threads has stopped, which until then may still answer a call.
    void pause(const std::string& host) const {
        ::kill(pid(host), SIGSTOP);
        for (int i = 0; i < 30'000 && !is_stopped(pid(host)); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    void resume(const std::string& host) const { ::kill(pid(host), SIGCONT); }
    pid_t pid(const std::string& host) const { return hosts_.at(host).pid(); }
    std::vector<std::filesystem::path> segments() const {
        std::vector<std::filesystem::path> found;
        for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
            if (file.path().filename().string().find(link_) != std::string::npos)
                found.push_back(file.path());
        return found;
    }
    bool left_in_shared_memory() const { return !segments().empty(); }

  private:
    static bool is_stopped(pid_t process) {
        const auto tasks = "/proc/" + std::to_string(process) + "/task";
        for (const auto& task : std::filesystem::directory_iterator(tasks)) {
            std::ifstream file(task.path() / "status");
            bool stopped = false;
            for (std::string line; std::getline(file, line);)
                stopped = stopped || line.starts_with("State:\tT");
            if (!stopped) return false;
        }
        return true;
    }
    void start(const std::string& host, std::vector<std::string> command) {
        command.insert(command.end(), {"--plugin-path", TEST_PLUGINS, "--parent-death"});
        command.insert(command.end(), switches_.begin(), switches_.end());
        const tandem::process::FileDescriptor log(
            open((folder_ / (host + ".log")).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
        hosts_.erase(host);
        hosts_.emplace(host, tandem::process::ChildProcess(command, {-1, log.get(), log.get(), ""}));
    }

    std::filesystem::path folder_;
    std::string link_, connections_, talker_properties_,
        talker_ = "TalkerComp", large_kib_, wait_ = "30", rtc_ = "EchoRtc", interceptor_ = "rtc=EchoRtc0",
        rtc_conf_more_, rtc_properties_, components_, adaptor_properties_, manager_port_, modules_,
        more_interceptors_;
    bool strict_ = true;
    int more_links_ = 0;
    std::vector<std::string> switches_;
    std::map<std::string, tandem::process::ChildProcess> hosts_;
};

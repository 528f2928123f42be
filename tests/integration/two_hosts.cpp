// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/two_hosts.hpp"

#include "host/process/run_command.hpp"

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

std::string unused_port() {
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

TwoHosts::TwoHosts() {
    std::string name = (std::filesystem::temp_directory_path() / "tandem-bridge-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    link_ = folder_.filename().string();
    for (const char* profile :
         {"TalkerComp.xml", "AlarmComp.xml", "CookComp.xml", "CameraComp.xml", "SurveyComp.xml",
          "MatrixComp.xml", "ServiceMatrixComp.xml", "GalleryComp.xml"})
        std::filesystem::copy_file(std::string(TEST_SOURCES "/opros/") + profile, folder_ / profile);
    connections_ = connection("data", "Talker", "word", "Adaptor", "word") +
                   connection("data", "Adaptor", "reply", "Talker", "reply") +
                   connection("service", "Talker", "dictionary", "Adaptor", "dictionary");
}

TwoHosts::~TwoHosts() {
    for (auto& [name, host] : hosts_) host.stop(std::chrono::seconds(30));
    std::filesystem::remove_all(folder_);
}

std::string TwoHosts::connection(const std::string& type, const std::string& from,
                                 const std::string& from_port, const std::string& to,
                                 const std::string& to_port) {
    return "<port_connection port_type=\"" + type + "\"><source component_name=\"" + from +
           "\" port_name=\"" + from_port + "\"/><target component_name=\"" + to + "\" port_name=\"" +
           to_port + "\"/></port_connection>\n";
}

void TwoHosts::set_rtc(const std::string& rtc) {
    rtc_ = rtc;
    set_interceptor("rtc=" + rtc + "0");
}

void TwoHosts::set_adaptor_property(const std::string& name, const std::string& value) {
    adaptor_properties_ += "<property name=\"" + name + "\">" + value + "</property>";
}

void TwoHosts::add_component(const std::string& name, const std::string& type,
                             const std::string& properties) {
    std::filesystem::copy_file(TEST_SOURCES "/opros/" + type + ".xml", folder_ / (type + ".xml"),
                               std::filesystem::copy_options::skip_existing);
    components_ += "<subcomponent><name>" + name + "</name><reference>" + type +
                   ".xml</reference><properties>" + properties + "</properties></subcomponent>\n";
}

std::string TwoHosts::property(const std::string& name, const std::string& value) {
    return "<property name=\"" + name + "\">" + value + "</property>";
}

void TwoHosts::leave_out_talker_and_rtc() {
    talker_.clear();
    connections_.clear();
    interceptor_.clear();
}

void TwoHosts::add_rtc(const std::string& type) {
    rtc_properties_ += ", " + type;
    if (type != rtc_) modules_ += type + ".so, ";
}

void TwoHosts::add_link(const std::string& adaptor, const std::string& rtc) {
    const std::string link = link_ + "-" + std::to_string(++more_links_ + 1);
    components_ += "<subcomponent><name>" + adaptor +
                   "</name><reference>AdaptorComp.xml</reference><properties>" + property("link", link) +
                   "</properties></subcomponent>\n";
    more_interceptors_ += ", InterceptorComp?link=" + link + "&rtc=" + rtc;
}

void TwoHosts::start_another_rtm(const std::string& port, const std::string& lines) {
    std::ofstream(folder_ / "other.conf")
        << "naming.enable: NO\nlogger.enable: NO\nmanager.shutdown_auto: NO\n"
        << lines;
    start("other", {RTM_HOST, "-f", (folder_ / "other.conf").string(), "-p", port});
}

std::filesystem::path TwoHosts::write_application() const {
    std::ofstream(folder_ / "app.xml")
        << "<?xml version=\"1.0\"?>\n<package_profile><name>app</name>\n<subcomponents>\n"
        << (talker_.empty()
                ? ""
                : "<subcomponent><name>Talker</name><reference>" + talker_ + ".xml</reference><properties>" +
                      talker_properties_ + "</properties></subcomponent>\n")
        << components_
        << "<subcomponent><name>Adaptor</name><reference>AdaptorComp.xml</reference><properties>"
        << "<property name=\"link\">" << link_ << "</property><property name=\"wait\">" << wait_
        << "</property><property name=\"large_kib\">" << large_kib_ << "</property>" << adaptor_properties_
        << "</properties></subcomponent>\n</subcomponents>\n<port_connections>\n"
        << connections_ << "</port_connections></package_profile>\n";
    std::filesystem::copy_file(
        std::filesystem::path(OPROS_HOST).parent_path() / "../plugins/opros/AdaptorComp.xml",
        folder_ / "AdaptorComp.xml", std::filesystem::copy_options::overwrite_existing);
    return folder_ / "app.xml";
}

void TwoHosts::start_opros() {
    std::vector<std::string> command{OPROS_HOST, write_application().string()};
    if (strict_) command.push_back("--strict");
    start("opros", command);
}

std::pair<int, std::string> TwoHosts::check_application(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command{"env",   "TANDEM_PLUGIN_PATH=" TEST_PLUGINS, TANDEM_PROGRAM, "opros",
                                     "check", write_application().string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto result = tandem::process::run_command(command, {.merge_errors = true});
    return {result.exit_code(), result.output};
}

void TwoHosts::write_rtc_conf() const {
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

void TwoHosts::start_rtm() {
    write_rtc_conf();
    std::vector<std::string> command{RTM_HOST, "-f", (folder_ / "rtc.conf").string()};
    if (!manager_port_.empty()) command.insert(command.end(), {"-p", manager_port_});
    start("rtm", command);
}

std::string TwoHosts::output(const std::string& host) const {
    std::ifstream file(folder_ / (host + ".log"));
    return {std::istreambuf_iterator<char>(file), {}};
}

bool TwoHosts::says(const std::string& host, const std::string& text, std::size_t from) const {
    for (int i = 0; i < 1500; ++i) {
        if (output(host).find(text, from) != std::string::npos) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

int TwoHosts::exit_code(const std::string& host) {
    const auto& ended = hosts_.at(host).wait(std::chrono::seconds(60));
    return ended && !ended->signalled ? ended->code : -1;
}

int TwoHosts::stop(const std::string& host) {
    const auto& ended = hosts_.at(host).stop(std::chrono::seconds(30));
    return ended && !ended->signalled ? ended->code : -1;
}

bool TwoHosts::stop_both() {
    for (const auto& [name, host] : hosts_) ::kill(host.pid(), SIGTERM);
    const int opros = exit_code("opros"), rtm = exit_code("rtm");
    return opros == 0 && rtm == 0;
}

void TwoHosts::kill(const std::string& host) {
    ::kill(hosts_.at(host).pid(), SIGKILL);
    hosts_.at(host).wait(std::chrono::seconds(30));
    hosts_.erase(host);
}

std::size_t TwoHosts::restart_rtm(const std::string& host) {
    kill("rtm");
    if (!says("opros", "is down: the peer process has gone"))
        throw std::runtime_error("opros_host has not noticed a death");
    const std::size_t before = output(host).size();
    start_rtm();
    return before;
}

void TwoHosts::pause(const std::string& host) const {
    ::kill(pid(host), SIGSTOP);
    for (int i = 0; i < 30'000 && !is_stopped(pid(host)); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::vector<std::filesystem::path> TwoHosts::segments() const {
    std::vector<std::filesystem::path> found;
    for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
        if (file.path().filename().string().find(link_) != std::string::npos) found.push_back(file.path());
    return found;
}

bool TwoHosts::is_stopped(pid_t process) {
    const auto tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
        std::ifstream file(task.path() / "status");
        bool stopped = false;
        for (std::string line; std::getline(file, line);) stopped = stopped || line.starts_with("State:\tT");
        if (!stopped) return false;
    }
    return true;
}

void TwoHosts::start(const std::string& host, std::vector<std::string> command) {
    command.insert(command.end(), {"--plugin-path", TEST_PLUGINS, "--parent-death"});
    command.insert(command.end(), switches_.begin(), switches_.end());
    const tandem::process::FileDescriptor log(
        open((folder_ / (host + ".log")).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
    hosts_.erase(host);
    hosts_.emplace(host, tandem::process::ChildProcess(command, {-1, log.get(), log.get(), ""}));
}

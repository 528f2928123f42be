// SPDX-License-Identifier: Apache-2.0
// A folder with an OPRoS application and an rtc.conf, and hosts started on them.
#pragma once

#include "host/process/child_process.hpp"

#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

/// Returns a port of 127.0.0.1 without a listener.
std::string unused_port();

/// The files of a bridge between TalkerComp and EchoRtc0; texts may be changed before they are used.
class TwoHosts {
  public:
    TwoHosts();
    ~TwoHosts();
    TwoHosts(const TwoHosts&) = delete;
    TwoHosts& operator=(const TwoHosts&) = delete;

    static std::string connection(const std::string& type, const std::string& from,
                                  const std::string& from_port, const std::string& to,
                                  const std::string& to_port);
    void set_connections(const std::string& xml) { connections_ = xml; }
    /// The OPRoS component that is created as Talker.
    void set_talker(const std::string& component) { talker_ = component; }
    void set_talker_properties(const std::string& xml) { talker_properties_ = xml; }
    /// The RTC behind the bridge.
    void set_rtc(const std::string& rtc);
    /// Properties of that RTC, as in `slow_ms=100`.
    void set_rtc_properties(const std::string& properties) { rtc_properties_ = "?" + properties; }
    void set_large_kib(const std::string& of_adaptor) { large_kib_ = of_adaptor; }
    /// If set, one refused connection ends the OPRoS host.
    void set_strict(bool strict) { strict_ = strict; }
    /// More properties of AdaptorComp.
    void set_adaptor_property(const std::string& name, const std::string& value);
    void set_wait(const std::string& seconds) { wait_ = seconds; }
    void set_interceptor(const std::string& parameters) { interceptor_ = parameters; }
    void append_to_rtc_conf(const std::string& lines) { rtc_conf_more_ += lines; }
    /// One more OPRoS component, whose profile is in opros/; `properties` as an application profile has them.
    void add_component(const std::string& name, const std::string& type, const std::string& properties = "");
    static std::string property(const std::string& name, const std::string& value);
    void set_adaptor_properties(const std::string& xml) { adaptor_properties_ = xml; }
    /// Neither a Talker nor an RTC: the link has components of add_component() only.
    void leave_out_talker_and_rtc();
    /// A further RTC, created after the others.
    void add_rtc(const std::string& type);
    /// A further RTC of a type that rtm_host itself has, created after the others.
    void add_built_in_rtc(const std::string& arguments) { rtc_properties_ += ", " + arguments; }
    /// A further link, with an AdaptorComp of that name, for the RTC of that name.
    void add_link(const std::string& adaptor, const std::string& rtc);
    /// A third host, with an rtc.conf of these lines.
    void start_another_rtm(const std::string& port, const std::string& lines);
    /// rtm_host's manager is at this port of 127.0.0.1.
    void set_manager_port(const std::string& port) { manager_port_ = port; }
    /// More arguments of both hosts.
    void set_switches(const std::vector<std::string>& switches) { switches_ = switches; }
    const std::string& link() const { return link_; }

    /// Returns the application's profile.
    std::filesystem::path write_application() const;
    void start_opros();
    /// Runs `tandem opros check` on the application. Returns its exit code and what it printed.
    std::pair<int, std::string> check_application(const std::vector<std::string>& arguments = {}) const;
    const std::filesystem::path& folder() const { return folder_; }
    void write_rtc_conf() const;
    void start_rtm();

    /// Everything a host has written so far.
    std::string output(const std::string& host) const;
    bool says(const std::string& host, const std::string& text, std::size_t from = 0) const;
    /// Returns the exit code of a host that ends by itself; -1 if it does not end within a generous time.
    int exit_code(const std::string& host);
    bool runs(const std::string& host) { return !hosts_.at(host).poll(); }
    int stop(const std::string& host);
    /// Asks both hosts to end at the same time. Returns true if both have ended cleanly.
    bool stop_both();
    void kill(const std::string& host);
    /// Kills rtm_host, waits until opros_host has noticed, and starts it again. Where the new output of `host` begins.
    std::size_t restart_rtm(const std::string& host);
    /// Stops a host by SIGSTOP; returns when each of its threads has stopped, which until then may still answer a call.
    void pause(const std::string& host) const;
    void resume(const std::string& host) const { ::kill(pid(host), SIGCONT); }
    pid_t pid(const std::string& host) const { return hosts_.at(host).pid(); }
    std::vector<std::filesystem::path> segments() const;
    bool left_in_shared_memory() const { return !segments().empty(); }

  private:
    static bool is_stopped(pid_t process);
    void start(const std::string& host, std::vector<std::string> command);

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

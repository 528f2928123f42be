// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/child_process.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::bench {

/// One of the two hosts, started as a user starts it, on the files of a folder; its log is opros.log or rtm.log there.
/// It ends with this object, and when this process is killed.
class BenchHost {
  public:
    enum class Model { opros, rtm };

    /// Starts opros_host on app.xml, or rtm_host on rtc.conf, with more arguments of the host. Throws std::system_error.
    BenchHost(Model model, const std::filesystem::path& folder,
              const std::vector<std::string>& arguments = {});

    /// Throws std::runtime_error, with what the log begins with, if the host has ended.
    void require_running();
    /// Sleeps until a file of that name is moved into the host's folder, or the host ends: then as require_running(). No timer wakes
    /// this thread meanwhile, since it runs on a core that a host measures on. Throws std::system_error.
    void wait_for(const std::string& file);
    /// "opros_host: the first line of its log"
    std::string first_log_line() const;
    pid_t pid() const { return process_.pid(); }
    void stop();

  private:
    std::string name_;
    std::filesystem::path folder_, log_;
    process::ChildProcess process_;
};

/// An element of an OPRoS application profile; `type`: data, service or event.
std::string connection_xml(const char* type, const std::string& from, const std::string& from_port,
                           const std::string& to, const std::string& to_port);

/// An element of an OPRoS application profile; each property is a name and a value.
std::string component_xml(const std::string& name, const std::string& reference,
                          const std::vector<std::pair<std::string, std::string>>& properties);

/// The OPRoS application profile of these elements.
std::string application_xml(const std::string& components, const std::string& connections);

/// What all rtc.conf of the bench begin with: no name server, no log, a period of 1 ms.
extern const char* const rtc_conf_head;

} // namespace tandem::bench

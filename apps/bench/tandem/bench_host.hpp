// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/child_process.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::bench {

/// One of the two hosts, started as a user starts it, with the files of a folder. Its log is opros.log or
/// rtm.log in that folder. It ends with this object, and when this process is killed.
class BenchHost {
  public:
    enum class Model { opros, rtm };

    /// Starts opros_host with app.xml, or rtm_host with rtc.conf, and with further arguments. Throws
    /// std::system_error.
    BenchHost(Model model, const std::filesystem::path& folder,
              const std::vector<std::string>& arguments = {});

    /// Throws std::runtime_error, with the beginning of the log, if the host has ended.
    void require_running();
    /// Sleeps until a file of that name is moved into the host's folder. Throws like require_running() if the
    /// host ends. No timer wakes this thread meanwhile, because it runs on a core on which a host measures.
    /// Throws std::system_error.
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

/// Returns an element of an OPRoS application profile; `type`: data, service or event.
std::string connection_xml(const char* type, const std::string& from, const std::string& from_port,
                           const std::string& to, const std::string& to_port);

/// Returns an element of an OPRoS application profile; each property is a name and a value.
std::string component_xml(const std::string& name, const std::string& reference,
                          const std::vector<std::pair<std::string, std::string>>& properties);

/// Returns the OPRoS application profile of these elements.
std::string application_xml(const std::string& components, const std::string& connections);

/// The beginning of every rtc.conf of the bench: no name server, no log, a period of 1 ms.
extern const char* const rtc_conf_head;

} // namespace tandem::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"

namespace tandem::wheelchair {

/// How to start one host of a run.
struct HostCommand {
    std::string name; // opros_host, rtm_host
    std::vector<std::string> command;
    std::string log;
};

/// The folder of one run: the hosts' profiles with the run's parameters, traces, logs. It is also an example:
/// the commands can be typed by hand.
///   opros/wheelchair.xml and the component profiles it names     rtm/rtc.conf and a .conf for each RTC
///   trace/COMPONENT.trace     log/HOST.log
class RunDirectory {
  public:
    /// Writes everything. `programs`: folder of the hosts' programs. Throws InputError.
    RunDirectory(const Options& options, Configuration configuration, const std::filesystem::path& programs);
    ~RunDirectory(); // removes the folder unless it is to be kept
    RunDirectory(const RunDirectory&) = delete;
    RunDirectory& operator=(const RunDirectory&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::string traces() const { return (path_ / "trace").string(); }
    const std::vector<HostCommand>& hosts() const { return hosts_; }
    /// Name of the link between the two halves; empty without one.
    const std::string& link() const { return link_; }
    /// Where the host listens for a conductor in lock-step.
    std::string step_socket(const std::string& host) const;

  private:
    void write_opros(const Options& options, Configuration configuration);
    void write_rtm(const Options& options, Configuration configuration);
    void add_host(const Options& options, const std::string& name, const std::filesystem::path& programs,
                  const std::vector<std::string>& profile);

    std::filesystem::path path_;
    std::filesystem::path sockets_; // apart and short: a socket's path may have 107 characters
    bool keep_;
    std::string link_;
    std::vector<HostCommand> hosts_;
};

/// Folder of the running program.
std::filesystem::path program_folder();

} // namespace tandem::wheelchair

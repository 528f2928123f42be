// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
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

/// A folder that goes with its owner unless it is to be kept.
class Folder {
  public:
    Folder(std::filesystem::path path, bool keep) : path_(std::move(path)), keep_(keep) {}
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool keep_;
};

/// The folder of one run: the hosts' profiles with the run's parameters, traces, logs. It is also an example:
/// the commands can be typed by hand.
///   opros/wheelchair.xml (component profiles lie beside the plugins)     rtm/rtc.conf and a .conf for each
///   RTC trace/COMPONENT.trace     log/HOST.log
class RunDirectory {
  public:
    /// Writes everything. `programs`: folder of the hosts' programs. Throws InputError.
    RunDirectory(const Options& options, Configuration configuration, const std::filesystem::path& programs);

    const std::filesystem::path& path() const { return folder_.path(); }
    std::string traces() const { return (path() / "trace").string(); }
    const std::vector<HostCommand>& hosts() const { return hosts_; }
    /// Name of the link between the two halves; empty without one.
    /// Of the links between the hosts, by the AdaptorComp that has it.
    const std::map<std::string, std::string>& links() const { return links_; }
    /// Where the host listens for a driver in lock-step.
    std::string step_socket(const std::string& host) const;

  private:
    void write_opros(const Options& options, Configuration configuration);
    void write_rtm(const Options& options, Configuration configuration);
    void add_host(const Options& options, const std::string& name, const std::filesystem::path& programs,
                  const std::vector<std::string>& profile);

    Folder folder_;
    Folder sockets_; // apart and short: a socket's path may have 107 characters
    std::map<std::string, std::string> links_;
    std::vector<HostCommand> hosts_;
};

/// Folder of the running program.
std::filesystem::path program_folder();

} // namespace tandem::wheelchair

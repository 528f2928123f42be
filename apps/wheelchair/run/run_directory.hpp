// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/hosts/supervisor.hpp"
#include "apps/wheelchair/options.hpp"

namespace tandem::wheelchair {

using hosts::HostCommand;

/// Owns a folder. Removes it at the end unless `keep` is true.
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

/// The folder of a run: profiles and configuration files with the run's parameters, traces and logs. Users can start
/// the hosts of a kept folder by hand. It contains:
///   opros/wheelchair.xml     application profile; component profiles are beside the plugins
///   rtm/rtc.conf             configuration of rtm_host, and COMPONENT0.conf for each RTC
///   trace/COMPONENT.trace    records of each component per tick (core/record/trace.hpp)
///   log/HOST.log             standard error of each host
class RunDirectory {
  public:
    /// Writes all files. `programs`: folder of the hosts' programs. Throws InputError if the folder to keep contains
    /// files other than an earlier run's, or cannot be written.
    RunDirectory(const Options& options, Configuration configuration, const std::filesystem::path& programs);

    const std::filesystem::path& path() const { return folder_.path(); }
    std::string traces() const { return (path() / "trace").string(); }
    const std::vector<HostCommand>& hosts() const { return hosts_; }
    /// Returns the names of the links between the two hosts, by the instance name of their AdaptorComp; empty unless
    /// the configuration has both hosts.
    const std::map<std::string, std::string>& links() const { return links_; }
    /// Returns the name of the link with the chair's state.
    std::string chair_link() const;
    /// Returns the path of the socket on which the host listens for the LockstepDriver.
    std::string step_socket(const std::string& host) const;

  private:
    void write_opros(const Options& options, Configuration configuration);
    void write_rtm(const Options& options, Configuration configuration);
    void add_host(const Options& options, const std::string& name, const std::filesystem::path& programs,
                  const std::vector<std::string>& profile);

    Folder folder_;
    Folder sockets_; // separate, because a socket's path has at most 107 characters
    std::map<std::string, std::string> links_;
    std::vector<HostCommand> hosts_;
};

/// Returns the folder of the running program, which also contains the hosts.
std::filesystem::path program_folder();

} // namespace tandem::wheelchair

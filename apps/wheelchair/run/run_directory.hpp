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

/// Owns a folder and removes it at the end, unless `keep` is true.
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

/// The folder of one run: profiles and configuration files with the run's parameters, traces and logs. A user
/// can start the hosts on a kept folder by hand. It contains:
///   opros/wheelchair.xml     application profile; component profiles are beside the plugins
///   rtm/rtc.conf             configuration of rtm_host, and COMPONENT0.conf for each RTC
///   trace/COMPONENT.trace    what each component did, tick by tick (core/record/trace.hpp)
///   log/HOST.log             standard error of each host
class RunDirectory {
  public:
    /// Writes all files. `programs` is the folder of the hosts' programs. Throws InputError when the folder
    /// to keep holds other files than an earlier run's, or cannot be written.
    RunDirectory(const Options& options, Configuration configuration, const std::filesystem::path& programs);

    const std::filesystem::path& path() const { return folder_.path(); }
    std::string traces() const { return (path() / "trace").string(); }
    const std::vector<HostCommand>& hosts() const { return hosts_; }
    /// Names of the links between the two hosts, by the instance name of their AdaptorComp; empty unless the
    /// configuration has both hosts.
    const std::map<std::string, std::string>& links() const { return links_; }
    /// Name of the link in which this program shows the chair.
    std::string chair_link() const;
    /// Path of the socket at which the host listens for the LockstepDriver.
    std::string step_socket(const std::string& host) const;

  private:
    void write_opros(const Options& options, Configuration configuration);
    void write_rtm(const Options& options, Configuration configuration);
    void add_host(const Options& options, const std::string& name, const std::filesystem::path& programs,
                  const std::vector<std::string>& profile);

    Folder folder_;
    Folder sockets_; // in a folder with a short path of its own: a socket's path has at most 107 characters
    std::map<std::string, std::string> links_;
    std::vector<HostCommand> hosts_;
};

/// Folder of the running program, where the hosts' programs are, too.
std::filesystem::path program_folder();

} // namespace tandem::wheelchair

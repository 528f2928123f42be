// SPDX-License-Identifier: Apache-2.0
// The folder of two joined components: opros/ with an application, rtm/rtc.conf.
#pragma once

#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/link/port_pairs.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

/// The instance name of AdaptorComp in the application.
constexpr char adaptor_name[] = "Adaptor";

/// A new folder, removed again with all that is in it unless keep() is called.
class JoinFolder {
  public:
    /// Throws std::runtime_error if the folder exists and is not empty, or cannot be made.
    JoinFolder(const std::filesystem::path& path, std::string link);
    ~JoinFolder();
    JoinFolder(const JoinFolder&) = delete;
    JoinFolder& operator=(const JoinFolder&) = delete;

    /// Writes rtm/rtc.conf, which creates the RTC and shares its ports. Returns what it has not taken over from an
    /// rtc.conf in the folder of the RTC, a line each.
    std::vector<std::string> write_rtc_conf(const ComponentPair& pair) const;
    /// Writes opros/AdaptorComp.xml and the application with these connections, and these ports of the RTC as event ports.
    void write_application(const ComponentPair& pair, const std::vector<PortPair>& connections,
                           const std::set<std::string>& event_ports) const;
    /// `NAME=VALUE`, for AdaptorComp in each application that is written from now on. Throws std::runtime_error when it has
    /// another form, or names what the folder itself sets.
    void add_property(const std::string& text);
    bool has_property(const std::string& name) const { return properties_.count(name) != 0; }
    std::vector<std::string> property_names() const;
    void keep() { keep_ = true; }

    const std::string& link() const { return link_; }
    std::filesystem::path rtc_conf() const { return path_ / "rtm" / "rtc.conf"; }
    std::filesystem::path application() const;

  private:
    std::filesystem::path path_;
    std::string link_;
    std::map<std::string, std::string> properties_;
    bool keep_ = false;
};

} // namespace tandem::command

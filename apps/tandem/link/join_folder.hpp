// SPDX-License-Identifier: Apache-2.0
// Writes the folder of two joined components: opros/ with an application, and rtm/rtc.conf.
#pragma once

#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/link/port_pairs.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

/// Instance name of AdaptorComp in the application.
constexpr char adaptor_name[] = "Adaptor";

/// A new folder. Unless keep() is called, it is removed with its contents.
class JoinFolder {
  public:
    /// Throws std::runtime_error if the folder exists and is not empty, or cannot be created.
    JoinFolder(const std::filesystem::path& path, std::string link);
    ~JoinFolder();
    JoinFolder(const JoinFolder&) = delete;
    JoinFolder& operator=(const JoinFolder&) = delete;

    /// Writes rtm/rtc.conf, which creates the RTC and shares its ports. Returns a line for each unused setting of the
    /// rtc.conf in the RTC's folder.
    std::vector<std::string> write_rtc_conf(const ComponentPair& pair) const;
    /// Writes opros/AdaptorComp.xml and the application. `event_ports`: ports of the RTC that become event ports.
    void write_application(const ComponentPair& pair, const std::vector<PortPair>& connections,
                           const std::set<std::string>& event_ports) const;
    /// Adds NAME=VALUE to AdaptorComp in all applications written afterwards. Throws std::runtime_error if the text has
    /// another form, or if the folder itself sets this property.
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

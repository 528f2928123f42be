// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"

#include <optional>

namespace tandem::command {

/// The ports behind a link, and whether an RTM host currently shares them.
struct LinkPorts {
    link::PortTable table;
    bool running = false;
};

/// Finds the ports behind links: from the running RTM host, or otherwise by a single trial run of an rtc.conf.
class LinkPortFinder {
  public:
    /// `conf`: empty if unknown. For the application profile A/opros/app.xml the default is A/rtm/rtc.conf.
    LinkPortFinder(std::filesystem::path conf, RtcConfOptions options)
        : conf_(std::move(conf)), options_(std::move(options)) {}

    /// Returns nullopt if no host shares ports on this link and the rtc.conf does not name it. Throws
    /// std::runtime_error if the shared data are damaged or the rtc.conf cannot be applied.
    std::optional<LinkPorts> find(const std::string& link);
    const std::filesystem::path& conf() const { return conf_; }
    /// Returns the links in the rtc.conf with the instance name of the RTC behind each. Throws like find().
    std::map<std::string, std::string> configured_links();

  private:
    const std::map<std::string, link::PortTable>& configured();

    std::filesystem::path conf_;
    RtcConfOptions options_;
    std::optional<std::map<std::string, link::PortTable>> configured_;
};

/// Returns FOLDER/rtm/rtc.conf for the application profile FOLDER/opros/app.xml; empty if there is none.
std::filesystem::path peer_rtc_conf(const std::filesystem::path& application);

} // namespace tandem::command

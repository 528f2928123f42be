// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"

#include <optional>

namespace tandem::command {

/// The ports behind a link, and whether an RTM host shares them at the moment.
struct LinkPorts {
    link::PortTable table;
    bool running = false;
};

/// Finds the ports behind links: of the RTM host that runs, otherwise of an rtc.conf, which is tried out once.
class LinkPortFinder {
  public:
    /// `conf`: empty if none is known. That of the application profile A/opros/app.xml is by default A/rtm/rtc.conf.
    LinkPortFinder(std::filesystem::path conf, RtcConfOptions options)
        : conf_(std::move(conf)), options_(std::move(options)) {}

    /// Nothing if no host shares ports on this link and the rtc.conf does not name it. Throws std::runtime_error: what is
    /// shared is damaged, or the rtc.conf cannot be carried out.
    std::optional<LinkPorts> find(const std::string& link);
    const std::filesystem::path& conf() const { return conf_; }
    /// The links that the rtc.conf names, with the instance name of the RTC behind each. Throws as find().
    std::map<std::string, std::string> configured_links();

  private:
    const std::map<std::string, link::PortTable>& configured();

    std::filesystem::path conf_;
    RtcConfOptions options_;
    std::optional<std::map<std::string, link::PortTable>> configured_;
};

/// The rtc.conf that belongs to an application profile: FOLDER/rtm/rtc.conf of FOLDER/opros/app.xml; empty without one.
std::filesystem::path peer_rtc_conf(const std::filesystem::path& application);

} // namespace tandem::command

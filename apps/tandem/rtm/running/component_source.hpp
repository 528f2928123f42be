// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

namespace tandem::command {

/// One component as list and tree show it.
struct ComponentEntry {
    std::string address; ///< rtcname://... or rtcloc://...
    std::string instance, type, state, category;
    CORBA::ULong ports = 0;
    RTC::RTObject_var object;
    std::string error; ///< why it does not answer; then only the address is known
};

/// One place where components are found, and what is there.
struct ComponentSource {
    std::string kind;    ///< name server, manager
    std::string address; ///< host:port
    std::string error;   ///< why it does not answer, with kind and address
    std::vector<ComponentEntry> components;
};

/// All name servers and managers. A component that several know is shown with each; one that does not answer
/// (a stale name) with its trouble.
std::vector<ComponentSource> enumerate_components(const RtmClient& client);

/// Throws std::runtime_error, one line, when none of the places answers, or not all that the user has named.
void require_reachable(const RtmClient& client, const std::vector<ComponentSource>& sources);

} // namespace tandem::command

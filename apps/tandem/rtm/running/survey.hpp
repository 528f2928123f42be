// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/running/peers.hpp"

namespace tandem::command {

/// One component as list and tree show it.
struct Seen {
    std::string address; ///< rtcname://... or rtcloc://...
    std::string instance, type, state, category;
    CORBA::ULong ports = 0;
    RTC::RTObject_var object;
    std::string trouble; ///< why it does not answer; then only the address is known
};

/// One place where components are found, and what is there.
struct Place {
    std::string kind;    ///< name server, manager
    std::string address; ///< host:port
    std::string trouble; ///< why it does not answer, with kind and address
    std::vector<Seen> components;
};

/// All name servers and managers. A component that several know is shown with each; one that does not answer
/// (a stale name) with its trouble.
std::vector<Place> survey(const Peers& peers);

/// Throws std::runtime_error, one line, when none of the places answers, or not all that the user has named.
void require_answers(const Peers& peers, const std::vector<Place>& places);

} // namespace tandem::command

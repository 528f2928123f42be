// SPDX-License-Identifier: Apache-2.0
// Listing all components that name servers and managers know.
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

namespace tandem::command {

/// A component as a name server or a manager lists it, with what it answers itself.
struct ComponentEntry {
    std::string address; ///< rtcname://... or rtcloc://...
    std::string instance, type, state, category;
    std::string callback; ///< `onActivated has taken 1.3 s so far`, or empty
    std::string describe_state() const { return state + (callback.empty() ? "" : " (" + callback + ")"); }
    CORBA::ULong ports = 0;
    RTC::RTObject_var object; ///< nil: its manager is still creating it
    std::string error; ///< why it does not answer, "" if it does; with an error only the address is known
};

/// A name server or a manager, and the components that it lists.
struct ComponentSource {
    std::string kind;    ///< name server, manager
    std::string address; ///< host:port
    std::string error;   ///< why it does not answer, with its kind and address; "" if it does
    std::vector<ComponentEntry> components;
};

/// Asks all name servers and managers of the client. A component that several of them know is listed with each;
/// one that does not answer (its process has died and left its name behind) is listed with its error. Does not
/// throw for a source that does not answer.
std::vector<ComponentSource> enumerate_components(const RtmClient& client);

/// Throws std::runtime_error, in one line, if no source has answered, or if one that the user has named has not.
void throw_if_sources_failed(const RtmClient& client, const std::vector<ComponentSource>& sources);

} // namespace tandem::command

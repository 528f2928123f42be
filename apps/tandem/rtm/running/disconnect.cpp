// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {
namespace {

// Returns whether a port is part of the connection.
bool includes_port(const RTC::ConnectorProfile& connection, RTC::PortService_ptr port) {
    for (CORBA::ULong i = 0; i < connection.ports.length(); ++i)
        if (connection.ports[i]->_is_equivalent(port)) return true;
    return false;
}

// OpenRTM-aist 1.2 to 2.1 deletes an InPort's connection while a read() may use it: RTC::InPort::read() takes it from
// the list without a lock. On a loaded machine, about one disconnection in a thousand crashes a component that reads in
// each cycle.
void warn_of_reader(RTC::PortService_ptr port) {
    RTC::PortProfile_var profile = port->get_port_profile();
    if (NVUtil::toString(profile->properties, "port.port_type") != "DataInPort" ||
        CORBA::is_nil(profile->owner) || is_in_tandem_host(profile->owner) ||
        component_state(profile->owner) != "ACTIVE")
        return;
    const std::string name(profile->name);
    const std::string component = name.substr(0, name.rfind('.'));
    print_note("tandem: warning: {0} is ACTIVE in a host of OpenRTM-aist, which may crash if {1} is "
               "disconnected while it reads; first run tandem rtm deactivate {0}\n",
               component, name);
}

void warn_of_readers(const RTC::ConnectorProfile& connection) {
    for (CORBA::ULong i = 0; i < connection.ports.length(); ++i) {
        try {
            warn_of_reader(connection.ports[i]);
        } catch (const CORBA::SystemException&) {
            // a port that is gone does not read
        }
    }
}

} // namespace

int rtm_disconnect(const RtmClientOptions& client_options, const DisconnectOptions& options) {
    const RtmClient client(client_options);
    const RemotePort first = find_port(client, options.port);
    RemotePort second;
    if (options.other) second = find_port(client, *options.other);
    nlohmann::json disconnected = nlohmann::json::array();
    call_remote(first.name, [&] {
        // The list is a copy, so ending a connection does not change it.
        RTC::ConnectorProfileList_var all = first.object->get_connector_profiles();
        for (CORBA::ULong i = 0; i < all->length(); ++i) {
            const std::string id(all[i].connector_id);
            if (!options.id.empty() && id != options.id) continue;
            if (!CORBA::is_nil(second.object.in()) && !includes_port(all[i], second.object.in())) continue;
            warn_of_readers(all[i]);
            const RTC::ReturnCode_t code = first.object->disconnect(id.c_str());
            if (code != RTC::RTC_OK)
                throw std::runtime_error("connection " + id + " cannot be disconnected: " + to_string(code));
            disconnected.push_back({{"id", id}, {"name", static_cast<const char*>(all[i].name)}});
        }
    });
    // An error if nothing matches, because a misspelt id would otherwise look like a success.
    if (disconnected.empty())
        throw std::runtime_error(first.name + " has no such connection" +
                                 (second.name.empty() ? "" : " with " + second.name));
    if (client_options.json)
        print_json(disconnected);
    else
        for (const auto& one : disconnected)
            print_text("disconnected " + one["name"].get<std::string>() + "\n");
    return 0;
}

} // namespace tandem::command

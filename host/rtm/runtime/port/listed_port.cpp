// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/port/listed_port.hpp"
#include "host/process/published/inventory.hpp"

namespace RTC {
namespace {

/// Returns "provided" or "required". A port may have interfaces of both kinds: what it provides counts.
std::string polarity_of(const PortInterfaceProfileList& interfaces) {
    for (CORBA::ULong i = 0; i < interfaces.length(); ++i)
        if (interfaces[i].polarity == PROVIDED) return "provided";
    return "required";
}

std::string types_of(const PortInterfaceProfileList& interfaces) {
    std::string types;
    for (CORBA::ULong i = 0; i < interfaces.length(); ++i)
        types += (types.empty() ? "" : ", ") + std::string(interfaces[i].type_name);
    return types;
}

} // namespace

void list_port(const PortBase* port, const PortProfile& profile) {
    const std::string name(profile.name);
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) return;
    const std::string kind = NVUtil::toString(profile.properties, "port.port_type");
    std::vector<std::string> fields{"port", name.substr(0, dot), name.substr(dot + 1)};
    if (kind == "CorbaPort")
        fields.insert(fields.end(),
                      {"service", polarity_of(profile.interfaces), types_of(profile.interfaces)});
    else
        fields.insert(fields.end(), {"data", kind == "DataInPort" ? "input" : "output",
                                     NVUtil::toString(profile.properties, "dataport.data_type")});
    for (CORBA::ULong i = 0; i < profile.connector_profiles.length(); ++i)
        fields.emplace_back(profile.connector_profiles[i].connector_id);
    tandem::process::list_part(port, fields);
}

} // namespace RTC

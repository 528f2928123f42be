// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/port/custom_serializer.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include <coil/stringutil.h>
#include <rtm/NVUtil.h>
#include <rtm/PortBase.h>

namespace RTC {
namespace {

// The type as the port's connector will find it in connector_properties(): the connection's property for this
// side, then the connection's for both sides, then the port's own configuration.
std::string marshaling_type(const ConnectorProfile& connection, const SDOPackage::NVList& port) {
    const bool is_in_port = NVUtil::toString(port, "port.port_type") == "DataInPort";
    const char* side_key =
        is_in_port ? "dataport.inport.marshaling_type" : "dataport.outport.marshaling_type";
    for (const char* key : {side_key, "dataport.marshaling_type"}) {
        std::string type = NVUtil::toString(connection.properties, key);
        if (!type.empty()) return type;
    }
    return NVUtil::toString(port, "marshaling_type");
}

} // namespace

bool uses_custom_serializer(const ConnectorProfile& profile) {
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        const auto local = local_object<PortBase>(profile.ports[i]);
        const std::string type = coil::eraseBothEndsBlank(
            local ? marshaling_type(profile, local->profileWithoutConnections().properties)
                  : marshaling_type(profile,
                                    PortProfile_var(profile.ports[i]->get_port_profile())->properties));
        if (!type.empty() && type != "cdr") return true;
    }
    return false;
}

} // namespace RTC

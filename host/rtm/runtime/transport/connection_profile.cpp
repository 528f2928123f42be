// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include "host/rtm/runtime/transport/shared_memory/obstacle.hpp"
#include <algorithm>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>
#include <rtm/NVUtil.h>

namespace RTC {

coil::Properties connector_properties(const coil::Properties& port, const ConnectorProfile& profile,
                                      const char* side) {
    coil::Properties connection = NVUtil::toProperties(profile.properties);
    coil::Properties merged(port);
    merged << connection.getNode("dataport");
    merged << connection.getNode(std::string("dataport.") + side);
    return merged;
}

ConnectorInfo connector_info(const ConnectorProfile& profile, const coil::Properties& properties) {
    coil::vstring ports;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        CORBA::String_var ior = Manager::instance().theORB()->object_to_string(profile.ports[i]);
        ports.push_back(ior.in());
    }
    return ConnectorInfo(profile.name, profile.connector_id, ports, properties);
}

namespace {

// The property is a list in order of preference; only the first entry counts here.
std::string preferred_byte_order(const coil::Properties& connector_properties) {
    const std::string orders = coil::normalize(connector_properties.getProperty("serializer.cdr.endian"));
    return orders.substr(0, orders.find(','));
}

} // namespace

bool is_little_endian(const coil::Properties& connector_properties) {
    return preferred_byte_order(connector_properties) != "big";
}

std::string unsupported_reason(const ConnectorProfile& profile, const coil::Properties& connector_properties,
                               bool in_port) {
    const std::string flow = coil::normalize(connector_properties.getProperty("dataflow_type", "push"));
    if (flow != "push" && flow != "pull") return "dataflow_type is " + flow + ", expected push or pull";
    const std::string type = coil::normalize(connector_properties.getProperty("interface_type"));
    const coil::vstring own_types{"", "corba_cdr", "data_service", "direct", "shared_memory"};
    if (std::find(own_types.begin(), own_types.end(), type) == own_types.end() &&
        registered_push_type(connector_properties).empty() &&
        registered_pull_type(connector_properties).empty())
        return "interface_type is " + type +
               ", expected corba_cdr, data_service, direct, shared_memory or one that a loaded library "
               "brings";
    // Push: an InPort provides, an OutPort consumes; pull: the other way round.
    const char* const key = in_port == (flow == "push") ? "provider_types" : "consumer_types";
    const std::string allowed = connector_properties.getProperty(key, "all");
    const auto types = coil::split(coil::normalize(allowed), ",", true);
    const std::string wanted = type.empty() ? "corba_cdr" : type;
    if (!types.empty() && !coil::includes(types, "all") && !coil::includes(types, wanted))
        return "interface_type is " + wanted + ", expected " + allowed + " (" + key + " of the port)";
    if (std::string obstacle = type == "shared_memory" ? shared_memory_obstacle(profile) : "";
        !obstacle.empty())
        return obstacle;
    const std::string order = preferred_byte_order(connector_properties);
    if (!order.empty() && order != "big" && order != "little")
        return "serializer.cdr.endian is " + order + ", expected little or big";
    const std::string length = connector_properties.getProperty("buffer.length");
    double messages = 0;
    if (!length.empty() && !(coil::stringTo(messages, length.c_str()) && messages >= 1 && messages <= 1e6))
        return "buffer.length is " + length + ", expected 1 to 1000000 messages";
    return "";
}

CORBA::Object_ptr find_published_object(const ConnectorProfile& profile, const std::string& key) {
    const CORBA::Long index = NVUtil::find_index(profile.properties, (key + "_ref").c_str());
    CORBA::Object_var object;
    if (index >= 0 &&
        (profile.properties[static_cast<CORBA::ULong>(index)].value >>= CORBA::Any::to_object(object.out())))
        return object._retn();
    const std::string ior = NVUtil::toString(profile.properties, (key + "_ior").c_str());
    return ior.empty() ? CORBA::Object::_nil() : Manager::instance().theORB()->string_to_object(ior.c_str());
}

void publish_object(ConnectorProfile& profile, const std::string& key, CORBA::Object_ptr object,
                    const std::string& ior) {
    CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV((key + "_ior").c_str(), ior.c_str()));
    CORBA::Any reference;
    reference <<= object;
    CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNVAny((key + "_ref").c_str(), reference));
}

} // namespace RTC

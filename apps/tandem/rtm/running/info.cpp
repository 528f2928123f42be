// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {
namespace {

using nlohmann::json;

// Returns only strings, because OpenRTM-aist's properties have no other values.
json properties_json(const SDOPackage::NVList& list) {
    json out = json::object();
    for (CORBA::ULong i = 0; i < list.length(); ++i) {
        const char* value = nullptr;
        if (list[i].value >>= value) out[static_cast<const char*>(list[i].name)] = value;
    }
    return out;
}

// Only service ports have interfaces. The type of a data port is one of its properties.
json ports_json(const RTC::PortProfileList& ports) {
    json list = json::array();
    for (CORBA::ULong i = 0; i < ports.length(); ++i) {
        const auto& port = ports[i];
        json interfaces = json::array(), connections = json::array();
        for (CORBA::ULong k = 0; k < port.interfaces.length(); ++k)
            interfaces.push_back({{"instance", port.interfaces[k].instance_name.in()},
                                  {"type", port.interfaces[k].type_name.in()},
                                  {"provided", port.interfaces[k].polarity == RTC::PROVIDED}});
        for (CORBA::ULong c = 0; c < port.connector_profiles.length(); ++c)
            connections.push_back({{"name", port.connector_profiles[c].name.in()},
                                   {"id", port.connector_profiles[c].connector_id.in()},
                                   {"ports", port.connector_profiles[c].ports.length()},
                                   {"properties", properties_json(port.connector_profiles[c].properties)}});
        list.push_back({{"name", port.name.in()},
                        {"interfaces", interfaces},
                        {"connections", connections},
                        {"properties", properties_json(port.properties)}});
    }
    return list;
}

// Enumeration values are valid indices, because omniORB refuses other values. Both arrays are in the order of the
// enumerations in RTC.idl.
json contexts_json(RTC::RTObject_ptr component, const std::string& instance) {
    static const char* const kinds[] = {"periodic", "event driven", "other"};
    static const char* const states[] = {"CREATED", "INACTIVE", "ACTIVE", "ERROR"};
    json list = json::array();
    for (auto& context : execution_contexts(component))
        list.push_back({{"handle", component->get_context_handle(context.in())},
                        {"kind", kinds[context->get_kind()]},
                        {"rate", context->get_rate()},
                        {"running", static_cast<bool>(context->is_running())},
                        {"state", states[context->get_component_state(component)]},
                        {"callback", ContextInfo(context.in()).describe_running_callback(instance)}});
    return list;
}

// Makes one remote call for the profile and one for each context, so the answers may be from different times.
json info_json(const RemoteComponent& component) {
    RTC::ComponentProfile_var profile = component.object->get_component_profile();
    SDOPackage::Configuration_var configuration = component.object->get_configuration();
    return {{"instance", profile->instance_name.in()},
            {"address", component.address},
            {"type", profile->type_name.in()},
            {"description", profile->description.in()},
            {"version", profile->version.in()},
            {"vendor", profile->vendor.in()},
            {"category", profile->category.in()},
            {"state", component_state(component.object.in())},
            {"contexts", contexts_json(component.object.in(), component.instance)},
            {"configuration", active_configuration_set(configuration.in())},
            {"ports", ports_json(profile->port_profiles)},
            {"properties", properties_json(profile->properties)}};
}

// Returns "" without the property. Service ports have no dataport.*.
std::string string_property(const json& properties, const char* key) {
    return properties.value(key, std::string());
}

// Converts the JSON, so that both formats have the same contents.
std::string format_info(const json& info) {
    std::string text =
        fmt::format("{}  {}\n", info["instance"].get<std::string>(), info["address"].get<std::string>());
    for (const char* key : {"type", "description", "version", "vendor", "category", "state", "configuration"})
        text += fmt::format("  {:<14} {}\n", key, info[key].get<std::string>());
    for (const auto& context : info["contexts"])
        text += fmt::format("  context {:<6} {}, {} Hz, {}, {}{}{}\n", context["handle"].get<int>(),
                            context["kind"].get<std::string>(), context["rate"].get<double>(),
                            context["running"].get<bool>() ? "running" : "stopped",
                            context["state"].get<std::string>(), context["callback"] == "" ? "" : "; ",
                            context["callback"].get<std::string>());
    for (const auto& port : info["ports"]) {
        text += fmt::format("  port {}  {} {}\n", port["name"].get<std::string>(),
                            string_property(port["properties"], "port.port_type"),
                            string_property(port["properties"], "dataport.data_type"));
        for (const auto& one : port["interfaces"])
            text += fmt::format("    {} {} as {}\n", one["provided"].get<bool>() ? "provides" : "requires",
                                one["type"].get<std::string>(), one["instance"].get<std::string>());
        for (const auto& one : port["connections"])
            text += fmt::format("    connection {}  {} {} {}\n", one["id"].get<std::string>(),
                                one["name"].get<std::string>(),
                                string_property(one["properties"], "dataport.dataflow_type"),
                                string_property(one["properties"], "dataport.interface_type"));
    }
    return text;
}

} // namespace

int rtm_info(const RtmClientOptions& options, const std::string& name) {
    const RtmClient client(options);
    const RemoteComponent component = client.find_component(name);
    const json info = call_remote(component.address, [&] { return info_json(component); });
    if (options.json)
        print_json(info);
    else
        print_text(format_info(info));
    return 0;
}

} // namespace tandem::command

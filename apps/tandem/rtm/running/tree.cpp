// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/running.hpp"
#include "apps/tandem/rtm/running/survey.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {
namespace {

struct PortLine {
    std::string name, kind, type;
    std::vector<std::string> connected_with;
};

// Names of the other ports of a connection; one whose process is gone is said to be.
std::string name_of(RTC::PortService_ptr port) {
    try {
        RTC::PortProfile_var profile = port->get_port_profile();
        return static_cast<const char*>(profile->name);
    } catch (const CORBA::SystemException&) {
        return "(unreachable)";
    }
}

std::vector<PortLine> ports_of(RTC::RTObject_ptr component) {
    std::vector<PortLine> lines;
    RTC::PortServiceList_var ports = component->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        PortLine line{static_cast<const char*>(profile->name),
                      NVUtil::toString(profile->properties, "port.port_type"),
                      NVUtil::toString(profile->properties, "dataport.data_type"),
                      {}};
        for (CORBA::ULong k = 0; k < profile->interfaces.length(); ++k) {
            const auto& one = profile->interfaces[k];
            line.type += fmt::format("{}{} {}", line.type.empty() ? "" : ", ",
                                     one.polarity == RTC::PROVIDED ? "provides" : "requires",
                                     static_cast<const char*>(one.type_name));
        }
        for (CORBA::ULong c = 0; c < profile->connector_profiles.length(); ++c) {
            const auto& connection = profile->connector_profiles[c];
            for (CORBA::ULong p = 0; p < connection.ports.length(); ++p)
                if (!connection.ports[p]->_is_equivalent(ports[i]))
                    line.connected_with.push_back(name_of(connection.ports[p]));
        }
        lines.push_back(line);
    }
    return lines;
}

} // namespace

int rtm_tree(const PeerOptions& options) {
    const Peers peers(options);
    nlohmann::json json = nlohmann::json::array();
    std::string text;
    const auto places = survey(peers);
    for (const auto& place : places) {
        nlohmann::json components = nlohmann::json::array();
        text += (place.trouble.empty() ? place.kind + " " + place.address : place.trouble) + "\n";
        for (const auto& seen : place.components) {
            nlohmann::json ports = nlohmann::json::array();
            std::string trouble = seen.trouble;
            text += fmt::format("  {} {}\n", seen.instance.empty() ? seen.address : seen.instance,
                                trouble.empty() ? seen.state : "UNREACHABLE (" + trouble + ")");
            try {
                if (trouble.empty())
                    for (const auto& port : ports_of(seen.object.in())) {
                        ports.push_back({{"name", port.name},
                                         {"kind", port.kind},
                                         {"type", port.type},
                                         {"connected_with", port.connected_with}});
                        text += fmt::format("    {} {} {}\n", port.name, port.kind, port.type);
                        for (const auto& other : port.connected_with) text += "      <-> " + other + "\n";
                    }
            } catch (const CORBA::SystemException& e) {
                trouble = e._name(); // it has gone just now
            }
            components.push_back({{"instance", seen.instance},
                                  {"address", seen.address},
                                  {"state", seen.state},
                                  {"trouble", trouble},
                                  {"ports", ports}});
        }
        json.push_back({{"kind", place.kind},
                        {"address", place.address},
                        {"trouble", place.trouble},
                        {"components", components}});
    }
    if (options.json)
        print_json(json);
    else
        print_text(text);
    require_answers(peers, places);
    return 0;
}

} // namespace tandem::command

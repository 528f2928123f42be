// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/port_type.hpp"

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

const char* port_type_name(PortType type) {
    switch (type) {
    case OPROS_EVENT:
        return "event";
    case OPROS_SERVICE:
        return "service";
    case OPROS_DATA:
    case OPROS_REMOTE_DATA:
        return "data";
    }
    return "unknown";
}

std::optional<PortType> parse_port_type(const std::string& name) {
    const std::string keyword = XmlFile::keyword(name);
    for (const PortType type : {OPROS_DATA, OPROS_EVENT, OPROS_SERVICE})
        if (keyword == port_type_name(type)) return type;
    return std::nullopt;
}

} // namespace tandem::engine

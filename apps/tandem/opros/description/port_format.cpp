// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/description/port_format.hpp"

#include "apps/tandem/output/table.hpp"

namespace tandem::command {

using nlohmann::json;

std::string format_ports(const json& ports) {
    Table table({"kind", "direction", "name", "type"});
    for (const json& port : ports) {
        // A service has methods instead of a data type. Each method is a line below the port.
        const bool service = port["kind"] == "service";
        const std::string type = service                  ? ""
                                 : port["type"].is_null() ? "any"
                                                          : port["type"].get<std::string>();
        table.add_row({port["kind"], port["direction"], port["name"], type});
        if (!service || !port.contains("methods")) continue;
        for (const json& method : port["methods"])
            table.add_row({"", "", "",
                           method["name"].get<std::string>() + ": " + method["signature"].get<std::string>() +
                               (method["call"] == "nonblocking" ? ", nonblocking" : "")});
    }
    return table.empty() ? "no ports\n" : table.text();
}

} // namespace tandem::command

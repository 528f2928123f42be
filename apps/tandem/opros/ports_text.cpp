// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/ports_text.hpp"

#include "apps/tandem/text.hpp"

namespace tandem::command {

using nlohmann::json;

std::string ports_text(const json& ports) {
    Table table({"kind", "direction", "name", "type"});
    for (const json& port : ports) {
        const bool service = port["kind"] == "service";
        const std::string type = service                  ? ""
                                 : port["type"].is_null() ? "any"
                                                          : port["type"].get<std::string>();
        table.add({port["kind"], port["direction"], port["name"], type});
        if (!service || !port.contains("methods")) continue;
        for (const json& method : port["methods"])
            table.add({"", "", "",
                       method["name"].get<std::string>() + ": " + method["signature"].get<std::string>() +
                           (method["call"] == "nonblocking" ? ", nonblocking" : "")});
    }
    return table.empty() ? "no ports\n" : table.text();
}

} // namespace tandem::command

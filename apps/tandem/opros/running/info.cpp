// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/opros/running/running_commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace tandem::command {
namespace {

using nlohmann::json;

std::string printable_text(const json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? replace_control_characters(found->get<std::string>())
                                                       : "";
}

double number_of(const json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

// "periodic, every 10 ms, phase 2 ms, priority 7"; leaves out zeros.
std::string format_executor(const json& info) {
    std::string text = printable_text(info, "executor");
    if (const double period = number_of(info, "period_ms"); period != 0)
        text += fmt::format(", every {} ms", period);
    if (const double phase = number_of(info, "phase_ms"); phase != 0)
        text += fmt::format(", phase {} ms", phase);
    if (const double priority = number_of(info, "priority"); priority != 0)
        text += fmt::format(", priority {}", priority);
    return text;
}

std::string table_of_ports(const json& info) {
    Table table({"port", "kind", "direction", "type"});
    for (const json& port : info.value("ports", json::array())) {
        const std::string kind = printable_text(port, "kind");
        const std::string type = kind == "service"                      ? ""
                                 : port.value("type", json()).is_null() ? "any"
                                                                        : printable_text(port, "type");
        table.add_row({printable_text(port, "name"), kind, printable_text(port, "direction"), type});
        for (const json& method : port.value("methods", json::array()))
            table.add_row(
                {"", "", "", printable_text(method, "name") + ": " + printable_text(method, "signature")});
    }
    return table.empty() ? "no ports\n" : table.text();
}

std::string format_connections(const json& info) {
    Table table({"connection", "from", "to", "state"});
    for (const json& each : info.value("connections", json::array())) {
        const std::string problem = printable_text(each, "problem");
        table.add_row({printable_text(each, "kind"), printable_text(each, "from"), printable_text(each, "to"),
                       problem.empty() ? "made" : "not made: " + problem});
    }
    return table.empty() ? "no connections in the application profile\n" : table.text();
}

std::string format_properties(const json& info) {
    const json properties = info.value("properties", json());
    if (properties.is_null()) return "its properties cannot be read, because its cycle has not ended\n";
    Table table({"property", "value"});
    for (const auto& [name, value] : properties.items())
        table.add_row({replace_control_characters(name),
                       value.is_string() ? replace_control_characters(value.get<std::string>()) : ""});
    return table.empty() ? "no properties\n" : table.text();
}

// Converts the JSON, so that both formats have the same contents.
std::string format_info(const json& info) {
    const std::string callback = printable_text(info, "callback"), error = printable_text(info, "last_error");
    std::string text =
        fmt::format("component  {}\nhost       opros_host {}\ntype       {}\nlibrary    {}\nprofile    {}\n"
                    "executor   {}\nstate      {}{}\n",
                    printable_text(info, "name"), info.value("pid", 0), printable_text(info, "type"),
                    printable_text(info, "library"), printable_text(info, "profile"), format_executor(info),
                    printable_text(info, "state"), callback.empty() ? "" : " (" + callback + ")");
    if (!error.empty()) text += "error      " + error + "\n";
    return text + "\n" + table_of_ports(info) + "\n" + format_connections(info) + "\n" +
           format_properties(info);
}

} // namespace

bool names_running_component(const std::filesystem::path& argument) {
    const std::string suffix = argument.extension().string();
    std::error_code none;
    return !argument.empty() && !is_xml(argument) && suffix != ".so" && suffix != ".dll" &&
           !std::filesystem::exists(argument, none);
}

int opros_running_info(const OprosClientOptions& options, const std::string& name) {
    const RunningComponent component = find_running_component(options, name);
    const json info = request_component(options, component, "info");
    if (options.json)
        print_json(info);
    else
        print_text(format_info(info));
    return 0;
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/service_differences.hpp"

#include "host/opros/engine/profile/type_profile.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// Removes every occurrence.
void remove(std::string& text, const std::string& part) {
    for (std::size_t at; (at = text.find(part)) != std::string::npos;) text.erase(at, part.size());
}

/// Removes std::, const, reference and spaces, so that both sides are comparable. ReturnType is another name of int.
std::string normalized(std::string type) {
    for (const char* part : {"std::", "const ", " const", "&", " "}) remove(type, part);
    return type == "ReturnType" ? "int" : type;
}

/// Returns for example `double(string,int)`.
std::string signature_of(const engine::MethodProfile& method) {
    std::string text = normalized(method.return_type) + "(";
    for (std::size_t i = 0; i < method.parameters.size(); ++i)
        text += (i ? "," : "") + normalized(method.parameters[i].type);
    return text + ")";
}

/// Compares the methods of a component's port with its service profile.
void compare(const std::string& port, const nlohmann::json& methods,
             const engine::ServiceTypeProfile& service, std::vector<std::string>& lines) {
    std::map<std::string, std::string> code;
    for (const auto& method : methods) code[method["name"]] = method["signature"];
    for (const auto& method : service.methods) {
        const auto found = code.find(method.name);
        if (found == code.end()) {
            lines.push_back(fmt::format("{}: service port '{}' of the component has no method '{}'",
                                        method.location.text(), port, method.name));
            continue;
        }
        if (normalized(found->second) != signature_of(method))
            lines.push_back(fmt::format("{}: method '{}' is {} here, {} in the component's port '{}'",
                                        method.location.text(), method.name, signature_of(method),
                                        normalized(found->second), port));
        code.erase(found);
    }
    for (const auto& [name, signature] : code)
        lines.push_back(fmt::format("{}: method '{}' of the component's port '{}' is not in this profile",
                                    service.location.text(), name, port));
}

} // namespace

std::vector<std::string> find_service_differences(const engine::ComponentProfile& profile,
                                                  const nlohmann::json& ports) {
    std::vector<std::string> lines;
    for (const auto& port : profile.service_ports) {
        const fs::path file = profile.location.file.parent_path() / port.reference;
        std::error_code ignored;
        if (port.reference.empty() || !fs::is_regular_file(file, ignored)) continue;
        const auto described = std::find_if(ports.begin(), ports.end(), [&](const auto& each) {
            return each["name"] == port.name && each.contains("methods");
        });
        if (described == ports.end()) continue; // find_port_mismatches() reports it
        try {
            const auto services = engine::read_service_type_profile(file);
            const auto named = std::find_if(services.begin(), services.end(),
                                            [&](const auto& each) { return each.name == port.type; });
            compare(port.name, (*described)["methods"], named == services.end() ? services.front() : *named,
                    lines);
        } catch (const engine::SetupError&) { // find_type_profile_errors() reports it
        }
    }
    return lines;
}

} // namespace tandem::command

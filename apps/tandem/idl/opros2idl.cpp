// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/idl/commands.hpp"
#include "apps/tandem/idl/idl_types.hpp"
#include "apps/tandem/output/print.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

using engine::MethodProfile;

/// Strips `text` of spaces at its end and of `suffix` before them. False if it does not end with it.
bool strip_suffix(std::string& text, std::string_view suffix) {
    if (text.size() < suffix.size() || text.compare(text.size() - suffix.size(), suffix.size(), suffix) != 0)
        return false;
    text.erase(text.size() - suffix.size());
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return true;
}

struct Passed {
    std::string type; ///< without const, reference and pointer
    bool writable = false;
};

/// What a method takes by a reference or pointer that is not const may come back written: IDL's inout.
Passed passed_type(std::string type) {
    Passed passed;
    const bool indirect = strip_suffix(type, "&") || strip_suffix(type, "*");
    const bool is_const = type.rfind("const ", 0) == 0;
    passed.writable = indirect && !is_const;
    passed.type = is_const ? type.substr(6) : type;
    return passed;
}

std::string idl_operation(const MethodProfile& method, IdlTypes& types) {
    std::string arguments;
    bool any_written = false;
    for (std::size_t i = 0; i < method.parameters.size(); ++i) {
        const auto& parameter = method.parameters[i];
        const auto passed = passed_type(parameter.type);
        any_written = any_written || passed.writable;
        const std::string by_type = passed.writable ? "inout" : "in";
        arguments += fmt::format(
            "{}{} {} {}", i ? ", " : "", parameter.direction.empty() ? by_type : parameter.direction,
            types.idl_type(passed.type),
            parameter.name.empty() ? fmt::format("a{}", i + 1) : idl_identifier(parameter.name));
    }
    const std::string result = types.idl_type(passed_type(method.return_type).type);
    const bool oneway = method.call_type == "nonblocking" && result == "void" && !any_written;
    std::string exceptions;
    for (const auto& name : method.exceptions)
        exceptions += (exceptions.empty() ? " raises (" : ", ") + types.exception(name);
    return fmt::format("  {}{} {}({}){}{};\n", oneway ? "oneway " : "", result, idl_identifier(method.name),
                       arguments, exceptions, exceptions.empty() ? "" : ")");
}

/// The attribute whose value the method returns; empty for one that sets it, which `service` has as well.
std::string idl_attribute(const MethodProfile& method, const engine::ServiceTypeProfile& service,
                          IdlTypes& types) {
    if (!method.parameters.empty()) return "";
    const bool can_be_set =
        std::any_of(service.methods.begin(), service.methods.end(), [&](const MethodProfile& other) {
            return other.attribute == method.attribute && !other.parameters.empty();
        });
    return fmt::format("  {}attribute {} {};\n", can_be_set ? "" : "readonly ",
                       types.idl_type(passed_type(method.return_type).type),
                       idl_identifier(method.attribute));
}

std::string idl_interface(const engine::ServiceTypeProfile& service,
                          const std::vector<engine::StructProfile>& structures) {
    const std::string full = service.idl_name.empty() ? service.name : service.idl_name;
    const auto scope = full.rfind("::");
    IdlTypes types(service.name + "Types", full, structures);
    std::string operations;
    for (const auto& method : service.methods) {
        try {
            operations += method.attribute.empty() ? idl_operation(method, types)
                                                   : idl_attribute(method, service, types);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(
                fmt::format("{}: method '{}': {}", method.location.text(), method.name, error.what()));
        }
    }
    const std::string name = scope == std::string::npos ? full : full.substr(scope + 2);
    return types.declarations() + in_modules(scope == std::string::npos ? "" : full.substr(0, scope),
                                             fmt::format("interface {} {{\n{}{}}};\n", idl_identifier(name),
                                                         types.declarations_in_interface(), operations));
}

} // namespace

int opros2idl(const Opros2IdlOptions& options) {
    std::vector<engine::StructProfile> structures;
    for (const auto& file : options.type_files)
        for (auto& structure : engine::read_data_type_profile(file))
            structures.push_back(std::move(structure));
    std::string text =
        fmt::format("// Made by tandem opros2idl from {}; changes are lost when it is made again.\n",
                    options.file.filename().string());
    for (const auto& service : engine::read_service_type_profile(options.file))
        text += idl_interface(service, structures);
    if (options.output.empty()) {
        print_text(text);
        return 0;
    }
    std::ofstream out(options.output);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(fmt::format("{} cannot be written", options.output.string()));
    return 0;
}

} // namespace tandem::command

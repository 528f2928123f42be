// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/type_profile.hpp"

#include "host/opros/engine/profile/xml_file.hpp"
#include "host/text/split_names.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

namespace tandem::engine {
namespace {

/// Returns the parameter's index attribute, or `default_index` if there is none.
std::size_t parameter_index(const XmlFile& xml, const pugi::xml_node& parameter, std::size_t default_index) {
    const std::string text = XmlFile::trim(parameter.attribute("index").value());
    std::size_t index = default_index;
    const char* const end = text.data() + text.size();
    if (!text.empty() && std::from_chars(text.data(), end, index).ptr != end)
        xml.fail(parameter, "index of a <param> is '" + text + "', expected a number of at least 0");
    return index;
}

std::string read_direction(const XmlFile& xml, const pugi::xml_node& parameter) {
    std::string direction = XmlFile::trim(parameter.attribute("direction").value());
    if (!direction.empty() && direction != "in" && direction != "out" && direction != "inout")
        xml.fail(parameter, "direction of a <param> is '" + direction + "', expected in, out or inout");
    return direction;
}

MethodProfile read_method(const XmlFile& xml, const pugi::xml_node& node) {
    MethodProfile method{xml.location(node),
                         xml.required_attribute(node, "name"),
                         XmlFile::trim(node.attribute("return_type").value()),
                         XmlFile::trim(node.attribute("call_type").value()),
                         {},
                         XmlFile::trim(node.attribute("attribute").value()),
                         text::split_words(node.attribute("raises").value())};
    if (method.return_type.empty()) method.return_type = "void";
    std::vector<std::pair<std::size_t, ParameterProfile>> indexed;
    for (const pugi::xml_node& parameter : node.children("param")) {
        const std::size_t index = parameter_index(xml, parameter, indexed.size() + 1);
        indexed.emplace_back(index, ParameterProfile{xml.required_child_text(parameter, "type"),
                                                     XmlFile::child_text(parameter, "name"),
                                                     read_direction(xml, parameter)});
    }
    // Parameters may be in any order. Parameters without an index or with equal indexes keep their order.
    std::stable_sort(indexed.begin(), indexed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [index, parameter] : indexed) method.parameters.push_back(std::move(parameter));
    return method;
}

using TypeKind = StructProfile::Kind;

/// Returns nothing for an element of another kind.
std::optional<TypeKind> kind_of(const pugi::xml_node& node) {
    const std::string name = node.name();
    if (name == "struct")
        return XmlFile::trim(node.attribute("array").value()) == "yes" ? TypeKind::array
                                                                       : TypeKind::structure;
    if (name == "enum") return TypeKind::enumeration;
    if (name == "union") return TypeKind::union_type;
    if (name == "exception") return TypeKind::exception;
    return std::nullopt;
}

StructProfile read_type(const XmlFile& xml, const pugi::xml_node& node, TypeKind kind) {
    StructProfile type{xml.location(node), xml.required_attribute(node, "name"), {}, kind};
    if (kind == TypeKind::union_type) type.discriminator = xml.required_attribute(node, "discriminator");
    for (const pugi::xml_node& item : node.children("item")) {
        FieldProfile field{kind == TypeKind::enumeration ? "" : xml.required_attribute(item, "type"),
                           XmlFile::trim(item.child_value()), item.attribute("default").value(),
                           XmlFile::trim(item.attribute("size").value())};
        if (kind == TypeKind::union_type) field.cases = xml.required_attribute(item, "case");
        if (field.name.empty()) xml.fail(item, "<item> lacks its text, the name of the field");
        type.fields.push_back(std::move(field));
    }
    if (kind == TypeKind::array && (type.fields.size() != 1 || type.fields[0].size.empty()))
        xml.fail(node, "an array has one <item> with its size, as in size=\"[4]\"");
    return type;
}

} // namespace

std::vector<ServiceTypeProfile> read_service_type_profile(const std::filesystem::path& file) {
    return read_service_type_profile(XmlFile(file));
}

std::vector<ServiceTypeProfile> read_service_type_profile(const XmlFile& xml) {
    const pugi::xml_node root = xml.root({"service_port_type_profile"});
    std::vector<ServiceTypeProfile> types;
    for (const pugi::xml_node& node : root.children("service_port_type")) {
        ServiceTypeProfile type{xml.location(node),
                                xml.required_child_text(node, "type_name"),
                                {},
                                XmlFile::trim(node.child("type_name").attribute("idl").value())};
        std::set<std::string> names;
        for (const pugi::xml_node& method : node.children("method")) {
            type.methods.push_back(read_method(xml, method));
            if (!names.insert(type.methods.back().name).second)
                xml.fail(method, "method '" + type.methods.back().name +
                                     "' is listed twice, expected one of each name");
        }
        types.push_back(std::move(type));
    }
    if (types.empty()) xml.fail(root, "<service_port_type_profile> lacks its <service_port_type>");
    return types;
}

std::vector<StructProfile> read_data_type_profile(const std::filesystem::path& file) {
    return read_data_type_profile(XmlFile(file));
}

std::vector<StructProfile> read_data_type_profile(const XmlFile& xml) {
    const pugi::xml_node root = xml.root({"data_type"});
    std::vector<StructProfile> types;
    for (const pugi::xml_node& node : root.children())
        if (const auto kind = kind_of(node)) types.push_back(read_type(xml, node, *kind));
    if (types.empty()) xml.fail(root, "<data_type> lacks its <struct>");
    return types;
}

} // namespace tandem::engine

// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/profile_kind.hpp"

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

namespace {

std::optional<ProfileKind> kind_of_root(const XmlFile& xml) {
    const std::string name = xml.root().name();
    if (name == "component_profile") return ProfileKind::component;
    if (name == "composite_component_profile") return ProfileKind::composite;
    if (name == "package_profile" || name == "application_profile") return ProfileKind::application;
    if (name == "service_port_type_profile") return ProfileKind::service_type;
    if (name == "data_type") return ProfileKind::data_type;
    return std::nullopt;
}

} // namespace

ProfileKind read_profile_kind(const std::filesystem::path& file) {
    const XmlFile xml(file);
    if (const auto kind = kind_of_root(xml)) return *kind;
    xml.fail(xml.root(), "root element is " + tag(xml.root().name()) +
                             ", expected <component_profile> or <composite_component_profile> or "
                             "<package_profile> or <application_profile> or <service_port_type_profile> or "
                             "<data_type>");
}

std::optional<ProfileKind> find_profile_kind(const std::filesystem::path& file) {
    return kind_of_root(XmlFile(file));
}

} // namespace tandem::engine

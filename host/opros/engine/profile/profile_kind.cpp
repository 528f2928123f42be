// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/profile_kind.hpp"

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

ProfileKind read_profile_kind(const std::filesystem::path& file) {
    const XmlFile xml(file);
    const std::string name = xml.root({"component_profile", "composite_component_profile", "package_profile",
                                       "application_profile", "service_port_type_profile", "data_type"})
                                 .name();
    if (name == "component_profile") return ProfileKind::component;
    if (name == "composite_component_profile") return ProfileKind::composite;
    if (name == "service_port_type_profile") return ProfileKind::service_type;
    return name == "data_type" ? ProfileKind::data_type : ProfileKind::application;
}

} // namespace tandem::engine

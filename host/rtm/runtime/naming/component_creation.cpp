// SPDX-License-Identifier: Apache-2.0
// OpenRTM-aist has no counterpart: its managers list a component only after onInitialize has returned.
#include "host/rtm/runtime/naming/component_creation.hpp"
#include <coil/stringutil.h>
#include <rtm/NVUtil.h>

namespace RTC {
namespace {

std::string creation_key(std::size_t index, const char* what) {
    return "creating." + std::to_string(index) + "." + what;
}

} // namespace

std::string ComponentCreation::text() const {
    return coil::sprintf("%s has taken %.1f s so far%s", callback.empty() ? "its creation" : callback.c_str(),
                         seconds, hangs() ? hanging_text : "");
}

coil::Properties to_properties(const std::vector<ComponentCreation>& creations) {
    coil::Properties properties;
    for (std::size_t i = 0; i < creations.size(); ++i) {
        properties.setProperty(creation_key(i, "instance_name"), creations[i].instance);
        properties.setProperty(creation_key(i, "type_name"), creations[i].type);
        properties.setProperty(creation_key(i, "callback"), creations[i].callback);
        properties.setProperty(creation_key(i, "seconds"), coil::sprintf("%.1f", creations[i].seconds));
    }
    return properties;
}

std::vector<ComponentCreation> components_being_created(RTM::Manager_ptr manager) {
    RTM::ManagerProfile_var profile = manager->get_profile();
    const coil::Properties properties = NVUtil::toProperties(profile->properties);
    std::vector<ComponentCreation> creations;
    // Another process provides the properties, so their number bounds the index.
    for (std::size_t i = 0; i < profile->properties.length(); ++i) {
        ComponentCreation creation;
        creation.instance = properties.getProperty(creation_key(i, "instance_name"));
        if (creation.instance.empty()) break;
        creation.type = properties.getProperty(creation_key(i, "type_name"));
        creation.callback = properties.getProperty(creation_key(i, "callback"));
        coil::stringTo(creation.seconds, properties.getProperty(creation_key(i, "seconds")).c_str());
        creations.push_back(creation);
    }
    return creations;
}

} // namespace RTC

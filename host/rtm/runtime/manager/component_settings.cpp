// SPDX-License-Identifier: Apache-2.0
// The properties of a new component. OpenRTM-aist: Manager::configureComponent(), mergeProperty() and the
// list of inherited properties in Manager::createComponent().
#include "host/rtm/runtime/manager/component_settings.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/configuration/conf_warning.hpp"
#include "host/rtm/runtime/configuration/format_name.hpp"

namespace RTC {
namespace {

// Applies the settings of rtc.conf that hold for every component. A setting that the user has made overrides the
// component's profile. A default of Tandem does not.
coil::Properties inherited_settings(const coil::Properties& config, const coil::Properties& profile) {
    coil::Properties out;
    auto inherit = [&](const std::string& key) {
        const std::string& value = config.getProperty(key);
        const bool is_default = value == config.getDefault(key);
        if (value.empty() || (is_default && !profile.getProperty(key).empty())) return;
        out.setProperty(key, value);
    };
    for (const char* key : {"config.version", "openrtm.name", "openrtm.version", "naming.formats"})
        inherit(key);
    for (const std::string section : {"exec_cxt", "ec", "port", "sdo.service"})
        if (const auto* node = config.findNode(section))
            for (const auto& key : node->propertyNames()) inherit(section + "." + key);
    return out;
}

// Adds the file CATEGORY.NAME.config_file, then the settings that rtc.conf has below CATEGORY.NAME. The file's
// path is relative to the working directory, then to the folder of rtc.conf.
void add_own_settings(const coil::Properties& config, const std::filesystem::path& folder,
                      const std::string& node_name, coil::Properties& out) {
    const auto* node = config.findNode(node_name);
    if (node == nullptr) return;
    const std::string file = node->getProperty("config_file");
    if (!file.empty()) {
        std::filesystem::path path(coil::replaceEnv(file));
        if (path.is_relative() && !std::filesystem::exists(path)) path = folder / path;
        if (std::filesystem::exists(path)) {
            read_conf_file(path, out);
        } else {
            // A warning only, as in OpenRTM-aist: rtc.conf is often passed on without the files it names.
            warn_about_setting("manager", node_name + ".config_file: file " + file +
                                              " does not exist; the component keeps its defaults");
        }
    }
    out << *node;
}

} // namespace

coil::Properties configure_component(Manager::Impl& impl, RTObject_impl& component,
                                     const coil::Properties& profile, const coil::Properties& arguments) {
    const coil::Properties config = impl.config_snapshot();
    coil::Properties properties = inherited_settings(config, profile);
    auto& listeners = impl.listeners.rtclifecycle_;
    listeners.forEach([&](auto& listener) { listener.preConfigure(properties); });
    const std::string category(component.getCategory());
    const std::string name(component.getInstanceName());
    const auto folder = impl.conf_file.parent_path();
    coil::Properties own_settings;
    add_own_settings(config, folder, category + "." + component.getTypeName(), own_settings);
    add_own_settings(config, folder, category + "." + name, own_settings);
    own_settings << arguments;
    properties << own_settings;
    // `Name?gain=2` is short for `Name?conf.default.gain=2` when the type has a parameter gain.
    for (const auto& key : arguments.propertyNames())
        if (profile.findNode("conf.default." + key) != nullptr)
            properties.setProperty("conf.default." + key, arguments.getProperty(key));
    properties.setProperty("instance_name", name);
    component.setProperties(properties);
    coil::Properties& own = component.getProperties();
    own.setProperty("naming.names", format_name(own.getProperty("naming.formats"), own, config));
    listeners.forEach([&](auto& listener) { listener.postConfigure(properties); });
    return own_settings;
}

} // namespace RTC

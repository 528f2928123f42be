// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/join_folder.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/output/write_file.hpp"

#include "host/opros/engine/load/plugin_dirs.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"

#include <coil/Properties.h>
#include <pugixml.hpp>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Copies AdaptorComp's profile, so that properties can be set for this link.
void copy_adaptor_profile(const fs::path& folder) {
    std::string searched;
    for (const auto& dir : engine::default_plugin_dirs()) {
        std::error_code error;
        if (fs::copy_file(dir / "AdaptorComp.xml", folder / "AdaptorComp.xml",
                          fs::copy_options::overwrite_existing, error))
            return;
        searched += (searched.empty() ? "" : ", ") + dir.string();
    }
    throw std::runtime_error("AdaptorComp.xml was not found in any of " + searched +
                             "; install Tandem again (cmake --install)");
}

pugi::xml_node add_subcomponent(pugi::xml_node list, const std::string& name, const std::string& reference) {
    auto entry = list.append_child("subcomponent");
    entry.append_child("name").text().set(name.c_str());
    entry.append_child("reference").text().set(reference.c_str());
    return entry;
}

void append_property(pugi::xml_node properties, const std::string& name, const std::string& value) {
    auto property = properties.append_child("property");
    property.append_attribute("name") = name.c_str();
    property.text().set(value.c_str());
}

void add_connection(pugi::xml_node list, const std::string& component, const PortPair& pair) {
    auto entry = list.append_child("port_connection");
    entry.append_attribute("port_type") = pair.opros["kind"].get<std::string>().c_str();
    const auto add_end = [&](const char* end, const std::string& of, const nlohmann::json& port) {
        auto node = entry.append_child(end);
        node.append_attribute("component_name") = of.c_str();
        node.append_attribute("port_name") = port["name"].get<std::string>().c_str();
    };
    if (pair.from_opros()) {
        add_end("source", component, pair.opros);
        add_end("target", adaptor_name, pair.rtc);
    } else {
        add_end("source", adaptor_name, pair.rtc);
        add_end("target", component, pair.opros);
    }
}

// Returns the settings for execution and for the RTC's own configuration from an existing rtc.conf. The other settings
// are about that file's modules, names and logs. Relative config files are in the folder of the rtc.conf.
std::string settings_taken_over(const fs::path& conf, std::vector<std::string>& left_out) {
    if (!is_there(conf)) return "";
    coil::Properties settings;
    RTC::read_conf_file(conf, settings);
    std::string text;
    for (auto& key : settings.propertyNames()) {
        const auto& value = settings.getProperty(key);
        if (value.empty()) continue;
        if (key.ends_with(".config_file"))
            text += key + ": " + (conf.parent_path() / value).string() + "\n";
        else if (key.starts_with("exec_cxt.") || key.find(".conf.") != std::string::npos)
            text += key + ": " + value + "\n";
        else
            left_out.push_back(conf.string() + ": '" + key + "' is not used");
    }
    return text;
}

} // namespace

JoinFolder::JoinFolder(const fs::path& path, std::string link)
    : path_(fs::absolute(path).lexically_normal()), link_(std::move(link)) {
    if (path_.filename().empty()) path_ = path_.parent_path(); // for a path written as DIR/
    std::error_code error;
    if (fs::exists(path_) && !(fs::is_directory(path_) && fs::is_empty(path_, error)))
        throw std::runtime_error(
            path_.string() + " exists and is not empty; remove it, or name another folder with --output DIR");
    for (const char* part : {"opros", "rtm"})
        if (!fs::create_directories(path_ / part, error) && error)
            throw std::runtime_error("folder " + (path_ / part).string() +
                                     " cannot be created: " + error.message());
}

JoinFolder::~JoinFolder() {
    std::error_code ignored; // a failed removal must not hide the original error
    if (!keep_) fs::remove_all(path_, ignored);
}

fs::path JoinFolder::application() const { return path_ / "opros" / (path_.filename().string() + ".xml"); }

std::vector<std::string> JoinFolder::write_rtc_conf(const ComponentPair& pair) const {
    const auto folder = pair.module.parent_path();
    std::vector<std::string> left_out;
    std::string text =
        "# Written by tandem link profile. Start rtm_host in this folder, as tandem run does.\n"
        "naming.enable: NO\nlogger.log_level: WARN\nmanager.shutdown_auto: NO\n"
        "manager.modules.load_path: " +
        folder.string() +
        "\n"
        "manager.modules.preload: " +
        pair.module.filename().string() +
        ", InterceptorComp.so\n"
        "manager.components.precreate: " +
        pair.type + ", InterceptorComp?link=" + link_ + "&rtc=" + pair.type + "0\n";
    const std::string own = settings_taken_over(folder / "rtc.conf", left_out);
    const auto conf = folder / (pair.type + ".conf"); // the file that rtc-template writes
    if (own.find(".config_file") == std::string::npos && is_there(conf))
        text += pair.category + "." + pair.type + ".config_file: " + conf.string() + "\n";
    write_file(rtc_conf(), text + own);
    return left_out;
}

void JoinFolder::add_property(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw std::runtime_error("--property " + text + ": expected NAME=VALUE");
    const std::string name = text.substr(0, equals);
    if (name == "link" || name == "event_ports")
        throw std::runtime_error("--property " + name + ": this property is set by the command" +
                                 (name == "link" ? "; name the link with --link" : ""));
    properties_[name] = text.substr(equals + 1);
}

std::vector<std::string> JoinFolder::property_names() const {
    std::vector<std::string> names;
    for (const auto& [name, value] : properties_) names.push_back(name);
    return names;
}

void JoinFolder::write_application(const ComponentPair& pair, const std::vector<PortPair>& connections,
                                   const std::set<std::string>& event_ports) const {
    copy_adaptor_profile(path_ / "opros");
    pugi::xml_document document;
    auto declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    auto package = document.append_child("package_profile");
    package.append_child("name").text().set(path_.filename().c_str());
    auto subcomponents = package.append_child("subcomponents");
    add_subcomponent(subcomponents, pair.opros.name, pair.opros.location.file.string());
    auto properties =
        add_subcomponent(subcomponents, adaptor_name, "AdaptorComp.xml").append_child("properties");
    append_property(properties, "link", link_);
    std::string names;
    for (const auto& name : event_ports) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty()) append_property(properties, "event_ports", names);
    for (const auto& [name, value] : properties_) append_property(properties, name, value);
    auto list = package.append_child("port_connections");
    for (const auto& each : connections) add_connection(list, pair.opros.name, each);
    if (!document.save_file(application().c_str(), "  "))
        throw std::runtime_error(application().string() + " cannot be written: " + std::strerror(errno));
}

} // namespace tandem::command

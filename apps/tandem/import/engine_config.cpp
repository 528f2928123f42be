// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/engine_config.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/xml_file.hpp"

#include <algorithm>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using engine::XmlFile;

fs::path find_system_xml(const fs::path& engine_dir) {
    for (const char* place : {"", "config", "conf"})
        if (fs::path file = engine_dir / place / "system.xml"; is_there(file)) return file;
    return {};
}

bool is_on(const std::string& text) {
    const std::string word = XmlFile::keyword(text);
    return word == "on" || word == "true" || word == "yes" || word == "1";
}

void tell_differences(const XmlFile& xml, const pugi::xml_node& root, ImportReport& report) {
    for (const auto& prop : root.child("system_props").children("prop")) {
        const std::string name = prop.attribute("name").value(), value = XmlFile::trim(prop.child_value());
        const auto differs = [&](const char* here) {
            report.add_difference(xml.location(prop).text(), name + " " + value, here);
        };
        if (name == "sys.console" && is_on(value))
            differs("there is no console: Ctrl-C ends the application, and tandem top shows it");
        if (name == "log.dir") differs("the log goes to standard error; as a service, to the journal");
    }
    for (const auto& io : root.child("io_manager").children("io"))
        if (!io.attribute("enable") || is_on(io.attribute("enable").value()))
            report.add_difference(xml.location(io).text(), std::string("io ") + io.attribute("id").value(),
                                  "not opened: there is no remote access by TCP");
}

/// Reads the addresses of the other nodes.
std::map<std::string, std::string> read_addresses(const XmlFile& xml, const pugi::xml_node& root,
                                                  ImportReport& report) {
    std::map<std::string, std::string> addresses;
    for (const auto& node : root.child("component_manager").child("node_map").children("node")) {
        const std::string id = node.attribute("id").value();
        for (const auto& prop : node.children("prop"))
            if (const std::string address = XmlFile::trim(prop.child_value());
                std::string(prop.attribute("name").value()) == "ip.addr" && !address.empty())
                addresses[id] = address;
        report.add_difference(xml.location(node).text(), "node " + id,
                              addresses.count(id) == 0
                                  ? "not connected: it has no ip.addr"
                                  : "reached by CORBA through port 2810; ip.port of <node_map> changes this");
    }
    return addresses;
}

/// The profiles of an engine's applications.
struct Applications {
    std::vector<fs::path> files;
    std::string unreadable; ///< the error of the first unreadable candidate
};

void add_application(const fs::path& file, Applications& found) {
    try {
        if (engine::find_profile_kind(file) == engine::ProfileKind::application) found.files.push_back(file);
    } catch (const engine::SetupError& error) {
        if (found.unreadable.empty()) found.unreadable = error.what();
        // Damaged profiles count too, so that reading them reports the error.
        const std::string text = read_text(file);
        if (text.find("<package_profile") != std::string::npos ||
            text.find("<application_profile") != std::string::npos)
            found.files.push_back(file);
    }
}

// Searches as deep as the engine's examples are, for example app/brill/hello/hello.xml.
Applications find_applications(const fs::path& folder) {
    constexpr int max_depth = 3;
    Applications found;
    std::error_code ignored; // unreadable folders count as empty
    for (auto entry =
             fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ignored);
         entry != fs::recursive_directory_iterator(); entry.increment(ignored)) {
        if (entry.depth() >= max_depth) entry.disable_recursion_pending();
        if (to_lower(entry->path().extension().string()) == ".xml" && !entry->is_directory(ignored))
            add_application(entry->path(), found);
    }
    std::sort(found.files.begin(), found.files.end());
    return found;
}

} // namespace

EngineConfig read_engine_config(const fs::path& engine_dir, ImportReport& report) {
    EngineConfig config{find_system_xml(engine_dir), "", engine_dir, {}};
    std::string deploy_dir = "Packages";
    if (!config.file.empty()) {
        const XmlFile xml(config.file);
        const auto root = xml.root({"system_config"});
        config.node_id = XmlFile::child_text(root, "local_node_id");
        for (const auto& prop : root.child("system_props").children("prop"))
            if (std::string(prop.attribute("name").value()) == "deploy.dir")
                deploy_dir = XmlFile::to_posix_path(XmlFile::trim(prop.child_value()));
        config.addresses = read_addresses(xml, root, report);
        tell_differences(xml, root, report);
    }
    if (fs::is_directory(engine_dir / deploy_dir)) config.deploy_dir = engine_dir / deploy_dir;
    return config;
}

fs::path find_application(const EngineConfig& config, const std::string& name) {
    if (!name.empty() && fs::is_regular_file(name)) return fs::canonical(name);
    const auto all = find_applications(config.deploy_dir);
    std::string names;
    std::vector<fs::path> chosen;
    for (const auto& file : all.files) {
        names += (names.empty() ? "" : ", ") + file.lexically_relative(config.deploy_dir).string();
        if (name.empty() || file.stem() == name) chosen.push_back(file);
    }
    if (chosen.size() == 1) return chosen.front();
    if (chosen.empty() && !all.unreadable.empty()) throw std::runtime_error(all.unreadable);
    if (all.files.empty())
        throw std::runtime_error(config.deploy_dir.string() +
                                 " has no application profile (XML with <package_profile> or "
                                 "<application_profile>); name one with --app FILE");
    throw std::runtime_error(
        config.deploy_dir.string() + " has " +
        (chosen.empty() ? "no application '" + name + "', but: " : "several applications: ") + names +
        "; choose one with --app " + (chosen.empty() ? "NAME" : "NAME or FILE"));
}

} // namespace tandem::command

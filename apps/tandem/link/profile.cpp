// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/plain_path.hpp"
#include "apps/tandem/link/commands.hpp"
#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/link/port_pairs.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/text/join.hpp"
#include "proxy/adaptor/property_check.hpp"
#include "proxy/wire/signature_match.hpp"
#include "shm/os/link_name.hpp"
#include "shm/segment/segment_file.hpp"

#include <coil/Properties.h>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::command {
namespace {

/// Instance name of AdaptorComp in the application.
constexpr char adaptor_name[] = "Adaptor";

namespace fs = std::filesystem;

// Copies AdaptorComp's profile, so that properties can be set for this link.
void copy_adaptor_profile(const fs::path& folder) {
    std::string searched;
    for (const auto& dir : plugin::default_plugin_dirs("opros")) {
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

/// A new folder. Unless keep() is called, it is removed with its contents.
class JoinFolder {
  public:
    /// Throws std::runtime_error if the folder exists and is not empty, or cannot be created.
    JoinFolder(const fs::path& path, std::string link)
        : path_(fs::absolute(path).lexically_normal()), link_(std::move(link)) {
        if (path_.filename().empty()) path_ = path_.parent_path(); // for a path written as DIR/
        std::error_code error;
        if (fs::exists(path_) && !(fs::is_directory(path_) && fs::is_empty(path_, error)))
            throw std::runtime_error(
                path_.string() +
                " exists and is not empty; remove it, or name another folder with --output DIR");
        for (const char* part : {"opros", "rtm"})
            if (!fs::create_directories(path_ / part, error) && error)
                throw std::runtime_error("folder " + (path_ / part).string() +
                                         " cannot be created: " + error.message());
    }

    ~JoinFolder() {
        std::error_code ignored; // a failed removal must not hide the original error
        if (!keep_) fs::remove_all(path_, ignored);
    }

    JoinFolder(const JoinFolder&) = delete;
    JoinFolder& operator=(const JoinFolder&) = delete;

    /// Writes rtm/rtc.conf, which creates the RTC and shares its ports. Returns a line for each unused setting of the
    /// rtc.conf in the RTC's folder.
    std::vector<std::string> write_rtc_conf(const ComponentPair& pair) const {
        require_conf_path(pair.module);
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

    /// Writes opros/AdaptorComp.xml and the application. `event_ports`: ports of the RTC that become event ports.
    void write_application(const ComponentPair& pair, const std::vector<PortPair>& connections,
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
        if (!event_ports.empty()) append_property(properties, "event_ports", text::join(event_ports, ", "));
        for (const auto& [name, value] : properties_) append_property(properties, name, value);
        auto list = package.append_child("port_connections");
        for (const auto& each : connections) add_connection(list, pair.opros.name, each);
        std::ostringstream text;
        document.save(text, "  ");
        write_file(application(), text.str());
    }

    /// Adds NAME=VALUE to AdaptorComp in all applications written afterwards. Throws std::runtime_error if the text has
    /// another form, or if the folder itself sets this property.
    void add_property(const std::string& text) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error("--property " + text + ": expected NAME=VALUE");
        const std::string name = text.substr(0, equals);
        if (name == "link" || name == "event_ports")
            throw std::runtime_error("--property " + name + ": this property is set by the command" +
                                     (name == "link" ? "; name the link with --link" : ""));
        properties_[name] = text.substr(equals + 1);
    }

    bool has_property(const std::string& name) const { return properties_.count(name) != 0; }
    std::vector<std::string> property_names() const {
        std::vector<std::string> names;
        for (const auto& [name, value] : properties_) names.push_back(name);
        return names;
    }

    void keep() { keep_ = true; }

    const std::string& link() const { return link_; }
    std::filesystem::path rtc_conf() const { return path_ / "rtm" / "rtc.conf"; }
    std::filesystem::path application() const {
        return path_ / "opros" / (path_.filename().string() + ".xml");
    }

  private:
    std::filesystem::path path_;
    std::string link_;
    std::map<std::string, std::string> properties_;
    bool keep_ = false;
};

namespace fs = std::filesystem;
using nlohmann::json;

/// Returns the ports of AdaptorComp: the mirrors and its own port.
json adaptor_ports(const link::PortTable& table, const std::set<std::string>& event_ports) {
    json ports = describe_mirrors(table, event_ports);
    ports.push_back({{"name", "linkState"}, {"kind", "data"}, {"direction", "output"}, {"type", nullptr}});
    return ports;
}

// Connects each pair in a child process, so that the host's own check decides.
void find_errors(std::vector<PortPair>& pairs, const ComponentPair& components, const link::PortTable& table,
                 const InspectOptions& options) {
    std::vector<TrialConnection> trials;
    for (const auto& pair : pairs) {
        engine::PortReference opros{components.opros.name, pair.opros["name"]},
            rtc{adaptor_name, pair.rtc["name"]};
        if (!pair.from_opros()) std::swap(opros, rtc);
        trials.push_back({port_type(pair.opros), opros, rtc});
    }
    const auto errors =
        try_connections_in_child(trials, {}, {{adaptor_name, link::encode_as_text(table)}}, options);
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].error = errors.at(i);
}

/// Returns the RTC's data ports whose messages can be events: an id and a content.
std::set<std::string> possible_event_ports(const link::PortTable& table) {
    std::set<std::string> names;
    for (const auto& port : table.ports) {
        if (!port.has_ring() || port.is_event_in_port()) continue;
        auto type = wire::parse_signature(port.signature);
        if (wire::is_timed(type)) type = wire::without_time(type);
        if (type.children.size() > 1 && type.children.front().kind == wire::Kind::string)
            names.insert(port.name);
    }
    return names;
}

/// Returns those of these ports that fit an event port of the OPRoS component. Writes the application with them as
/// event ports.
std::set<std::string> find_event_ports(const JoinFolder& folder, const ComponentPair& components,
                                       const json& opros_ports, const link::PortTable& table,
                                       const InspectOptions& options) {
    json events = json::array();
    for (const auto& port : opros_ports)
        if (port["kind"] == "event") events.push_back(port);
    const auto possible = possible_event_ports(table);
    std::set<std::string> found;
    if (events.empty() || possible.empty()) return found;
    folder.write_application(components, {}, possible);
    auto pairs = possible_pairs(events, describe_mirrors(table, possible));
    find_errors(pairs, components, table, options);
    for (const auto& pair : pairs)
        if (const std::string name = pair.rtc["name"]; pair.error.empty() && possible.contains(name))
            found.insert(name);
    return found;
}

/// Names the files only if `written`.
json report(const ComponentPair& components, const JoinFolder& folder, const PortMatch& match,
            const std::vector<std::string>& notes, bool written) {
    json connections = json::array();
    for (const auto& pair : match.pairs) {
        const std::string opros = components.opros.name + "." + pair.opros["name"].get<std::string>(),
                          rtc = components.type + "0." + pair.rtc["name"].get<std::string>();
        connections.push_back({{"kind", pair.opros["kind"]},
                               {"from", pair.from_opros() ? opros : rtc},
                               {"to", pair.from_opros() ? rtc : opros},
                               {"matched_by", pair.matched}});
    }
    json report{{"link", folder.link()},
                {"connections", connections},
                {"not_connected", match.left_out},
                {"notes", notes}};
    if (written) {
        report["application"] = folder.application().string();
        report["rtc_conf"] = folder.rtc_conf().string();
    }
    return report;
}

void print_report(const json& report, const std::string& folder) {
    std::string text;
    const bool written = report.contains("application");
    if (written) {
        text = "link       " + report["link"].get<std::string>() + "\nwritten    " +
               report["application"].get<std::string>() + "\n           " +
               report["rtc_conf"].get<std::string>() + "\n\n";
        Table table({"kind", "from", "to", "matched by"});
        for (const auto& each : report["connections"])
            table.add_row({each["kind"], each["from"], each["to"], each["matched_by"]});
        text += table.empty() ? "no port can be connected\n" : table.text();
        if (!report["not_connected"].empty()) text += "\n";
    }
    for (const auto& line : report["not_connected"])
        text += "not connected: " + replace_control_characters(line.get<std::string>()) + "\n";
    for (const auto& line : report["notes"])
        text += "note: " + replace_control_characters(line.get<std::string>()) + "\n";
    print_text(text + (written ? "\nnext: tandem run " + folder + "\n" : ""));
}

} // namespace

int link_profile(const LinkProfileOptions& options) {
    if (!options.link.empty()) shm::check_link_name(options.link);
    const ComponentPair components = find_component_pair(options);
    const fs::path out =
        options.out.empty() ? fs::path(components.opros.name + "-" + components.type) : options.out;
    JoinFolder folder(out, options.link.empty()
                               ? shm::as_link_name(components.opros.name + "-" + components.type)
                               : options.link);
    for (const auto& property : options.properties) folder.add_property(property);
    auto notes = folder.write_rtc_conf(components);
    folder.write_application(components, {}, {});

    RtcConfOptions conf_options;
    conf_options.timeout_s = options.timeout_s;
    const auto table = probe_rtc_conf(folder.rtc_conf(), conf_options).at(folder.link());
    InspectOptions inspect;
    inspect.file = folder.application();
    inspect.plugin_dirs = plugin::default_plugin_dirs("opros");
    inspect.initialize = options.initialize;
    inspect.timeout_s = options.timeout_s;
    const json opros_ports =
        describe_in_child(components.library, components.opros.location.file, inspect)["ports"];
    const auto event_ports = find_event_ports(folder, components, opros_ports, table, inspect);
    folder.write_application(components, {}, event_ports);
    const json rtc_ports = adaptor_ports(table, event_ports);
    auto pairs = possible_pairs(opros_ports, rtc_ports);
    find_errors(pairs, components, table, inspect);
    const auto match =
        match_ports(components.opros.name, opros_ports, components.type + "0", rtc_ports, pairs);
    if (opros_ports.empty() && !options.initialize)
        notes.push_back(
            components.opros.name +
            " creates its ports in onInitialize(); to run it in a child process, use --initialize");
    const auto without_port = adaptor::find_properties_without_port(folder.property_names(), table);
    notes.insert(notes.end(), without_port.begin(), without_port.end());
    const auto unknown = adaptor::find_unknown_properties(folder.property_names());
    notes.insert(notes.end(), unknown.begin(), unknown.end());
    folder.write_application(components, match.pairs, event_ports);
    // If properties share a component as an RTC, its connections are made on the RTM side.
    const bool joins = !match.pairs.empty() || folder.has_property("share");
    if (joins) folder.keep();

    const json result = report(components, folder, match, notes, joins);
    options.json ? print_json(result) : print_report(result, out.string());
    if (!joins)
        throw std::runtime_error("no port of " + components.opros.name + " fits one of " + components.type +
                                 "0, for the reasons above, so nothing is written; make ports fit with "
                                 "--property convert.PORT=... or names.PORT=...");
    return 0;
}

} // namespace tandem::command

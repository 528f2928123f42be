// SPDX-License-Identifier: Apache-2.0
// tandem rtm import: turns an installation of OpenRTM-aist into DIR/rtm for tandem run.
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/plain_path.hpp"
#include "apps/tandem/import/commands.hpp"
#include "apps/tandem/import/import_folder.hpp"
#include "apps/tandem/import/rtm_setup.hpp"
#include "apps/tandem/import/rts_profile.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/text/join.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns whether a connection property contains none of preconnect's separators.
bool fits_entry(const std::string& text) { return text.find_first_of(",&=?()\n\r") == std::string::npos; }

// Returns whether a stored property is a result of connecting rather than a setting.
bool is_outcome(const std::string& key, const std::string& value) {
    if (value.starts_with("IOR:") || key.ends_with("data_type") || key.ends_with("_ior") ||
        key.ends_with("_ref"))
        return true;
    if (key == "dataport.serializer.cdr.endian" && value == "little,big") return true; // the default
    return key == "port.port_type";
}

std::string with_article(bool is_service) { return is_service ? "service" : "data"; }

/// Adds a profile to a set-up.
class SystemReader {
  public:
    SystemReader(RtmSetup& setup, const RtsProfile& profile, ImportReport& report)
        : setup_(setup), profile_(profile), report_(report) {}

    void add(bool activate) {
        for (const auto& component : profile_.components) add_component(component);
        for (const auto& connection : profile_.connections) add_connection(connection);
        add_activation(activate);
        for (const auto& location : profile_.sequences)
            report_.add_difference(
                location.text(), "order of starting or stopping",
                "ignored: components are activated in the order of manager.components.preactivation");
    }

  private:
    const RtsComponent* find(const std::string& name) const {
        for (const auto& component : profile_.components)
            if (component.name == name) return &component;
        return nullptr;
    }

    void add_component(const RtsComponent& component) {
        const std::string where = component.location.text();
        if (!component.composite_type.empty())
            return report_.add_difference(where, component.name + ": composite " + component.composite_type,
                                          "not created: each member runs in a separate execution context");
        if (!setup_.creates(component.name) && !create(component))
            return report_.add_difference(
                where, component.name + " of type " + component.type,
                component.path.empty()
                    ? "stays in its own process, whose address is unknown: its connections are left out"
                    : "created neither by precreate nor by a module here: it stays in its own process, and "
                      "its ports are connected by CORBA at " +
                          remote_name(component.path) + ", as soon as it is running");
        if (!component.kind.empty() && component.kind != "PERIODIC")
            report_.add_difference(where, component.name + ": execution context " + component.kind,
                                   "ignored: rtc.conf and the component determine the context");
        if (component.rate > 0 && component.kind == "PERIODIC")
            add_setting(component, "exec_cxt.periodic.rate", fmt::format("{}", component.rate));
        for (const auto& set : component.sets)
            for (const auto& [name, value] : set.values)
                add_setting(component, "conf." + set.id + "." + name, value);
        if (!component.active_set.empty() && component.active_set != "default")
            add_setting(component, "configuration.active_config", component.active_set);
    }

    // Returns the type whose module is available; "" if there is none. Some tools write the instance's name in place of
    // the type.
    std::string find_type(const RtsComponent& component) const {
        std::vector<std::string> types{component.type};
        if (component.type == component.name)
            types.push_back(component.type.substr(0, component.type.find_last_not_of("0123456789") + 1));
        for (const auto& type : types) {
            const auto found = find_module(setup_, type);
            if (!found.library.empty() || !found.folder.empty()) return type;
        }
        return "";
    }

    // Creates a component that was a separate program, if its module or its source is available.
    bool create(const RtsComponent& component) {
        const std::string type = find_type(component), file = type + ".so";
        if (type.empty()) return false;
        if (std::find(setup_.modules.begin(), setup_.modules.end(), file) == setup_.modules.end())
            add_module(setup_, type, component.location.text(), report_);
        std::string entry = type;
        if (component.name != setup_.next_name(type)) entry += "?instance_name=" + component.name;
        setup_.components.push_back({entry, type, component.name, component.location.text()});
        report_.add_difference(component.location.text(), component.name + " of type " + type,
                               "runs in rtm_host, not as a separate program");
        return true;
    }

    // Adds the setting to rtc.conf as CATEGORY.INSTANCE.KEY, which overrides the component's files.
    void add_setting(const RtsComponent& component, const std::string& key, const std::string& value) {
        if (value.empty()) return;
        if (component.category.empty() || component.category.find_first_of(":=.") != std::string::npos)
            return report_.add_difference(
                component.location.text(), component.name + ": " + key + " " + value,
                "left out: category '" + component.category + "' cannot be part of a key of rtc.conf");
        setup_.settings.push_back(
            {component.category + "." + component.name + "." + key, value, component.location.text()});
    }

    // Returns HOST/CONTEXT/NAME.rtc in the form that preconnect accepts.
    static std::string remote_name(std::string path) {
        if (path.ends_with(".rtc")) path.resize(path.size() - 4);
        return "rtcname://" + path;
    }

    // Returns the port's name for preconnect; "" if its component is unknown.
    std::string port_name(const RtsPort& port) const {
        if (setup_.creates(port.component)) return port.text();
        const RtsComponent* component = find(port.component);
        const std::string path =
            component != nullptr && !component->path.empty() ? component->path : port.path;
        if (path.empty() || (component != nullptr && !component->composite_type.empty())) return "";
        return remote_name(path) + "." + port.port;
    }

    void add_connection(const RtsConnection& connection) {
        const std::string where = connection.location.text(),
                          what = connection.source.text() + " to " + connection.target.text();
        const std::string from = port_name(connection.source), to = port_name(connection.target);
        if (from.empty() || to.empty())
            return report_.add_difference(
                where, what,
                "left out: " + (from.empty() ? connection.source : connection.target).component +
                    " is not created here, and its name server is unknown");
        if (from.starts_with("rtcname") && to.starts_with("rtcname"))
            return report_.add_difference(where, what,
                                          "left out, because both ports are in other processes; to connect "
                                          "them, run tandem rtm connect " +
                                              from + " " + to);
        if (is_connected(from, to)) return;
        std::string entry = from + "?port=" + to;
        for (const auto& [key, value] : connection.properties) entry += property(connection, key, value);
        setup_.connections.push_back(entry);
    }

    std::string property(const RtsConnection& connection, const std::string& key, const std::string& value) {
        const std::string where = connection.location.text();
        if (key.find(".required.") != std::string::npos && !value.empty())
            report_.add_difference(where, key,
                                   "left out: services are matched by interface and instance name");
        if (is_outcome(key, value)) return "";
        const std::string short_key = key.starts_with("dataport.") ? key.substr(9) : key;
        if (short_key == "interface_type" && !has_interface_type(setup_, value)) {
            report_.add_difference(where, short_key + " " + value,
                                   "not available for " + with_article(connection.is_service) +
                                       " ports: corba_cdr");
            return "&interface_type=corba_cdr";
        }
        const bool is_setting = key.starts_with("dataport.") || key.starts_with("port.");
        if (!is_setting || !fits_entry(key) || !fits_entry(value)) {
            report_.add_difference(where, key + " " + value,
                                   is_setting
                                       ? "left out: preconnect does not allow this value"
                                       : "left out: settings of connections begin with dataport. or port.");
            return "";
        }
        return "&" + short_key + "=" + value;
    }

    // rtc.conf may already contain the connection, in either notation and direction.
    bool is_connected(const std::string& from, const std::string& to) const {
        return std::any_of(setup_.connections.begin(), setup_.connections.end(),
                           [&](const std::string& entry) {
                               const std::string ports = entry.substr(0, entry.find_first_of("&("));
                               return ports == from + "?port=" + to || ports == to + "?port=" + from ||
                                      ports == from + ":" + to || ports == to + ":" + from;
                           });
    }

    // Restoring a system in RTSystemEditor does not activate it.
    void add_activation(bool activate) {
        std::string left;
        for (const auto& component : profile_.components) {
            auto& list = setup_.activations;
            const bool listed = std::find(list.begin(), list.end(), component.name) != list.end();
            if (activate && !setup_.creates(component.name))
                report_.add_difference(component.location.text(), component.name + ": activation",
                                       "left out: it is in another process; activate it there");
            if (!setup_.creates(component.name) || listed) continue;
            if (activate)
                list.push_back(component.name);
            else
                left += " " + component.name;
        }
        if (!left.empty())
            report_.add_difference(profile_.file.string(), "activation by a person",
                                   "activate them with tandem rtm activate" + left +
                                       ", by AdaptorComp if they are behind a link, or at the start by "
                                       "importing with --activate");
    }

    RtmSetup& setup_;
    const RtsProfile& profile_;
    ImportReport& report_;
};

/// Returns the RTSystem profile of an installation, in its folder or in system/; "" if there is none. Throws
/// std::runtime_error if there are several.
fs::path find_rts_profile(const fs::path& installation) {
    std::vector<fs::path> found;
    for (const char* place : {"", "system"})
        for (const auto& file : list_entries(installation / place, ".xml"))
            if (is_rts_profile(file)) found.push_back(fs::absolute(file).lexically_normal());
    if (found.size() < 2) return found.empty() ? fs::path() : found.front();
    std::string names;
    for (const auto& file : found)
        names += (names.empty() ? "" : ", ") +
                 file.lexically_relative(fs::absolute(installation).lexically_normal()).string();
    throw std::runtime_error(installation.string() + " has several RTSystem profiles: " + names +
                             "; choose one with --system FILE");
}

/// Does what RTSystemEditor does with the profile: sets up and connects its components. Components that cannot be
/// created by precreate or by a module in the installation remain in separate processes and are connected by CORBA.
void add_system(RtmSetup& setup, const RtsProfile& profile, bool activate, ImportReport& report) {
    SystemReader(setup, profile, report).add(activate);
}

namespace fs = std::filesystem;

// Reports managers for other languages. wasanbon writes their configurations beside the one for C++.
void tell_other_languages(const RtmSetup& setup, ImportReport& report) {
    for (const auto& [file, language] : {std::pair("rtc_py.conf", "Python"), {"rtc_java.conf", "Java"}}) {
        const fs::path conf = setup.conf.parent_path() / file;
        if (!is_there(conf)) continue;
        RtmSetup other;
        other.installation = setup.installation;
        other.conf = conf;
        ImportReport ignored; // that manager does not change, so its differences are irrelevant
        try {
            read_rtc_conf(other, ignored);
        } catch (const std::runtime_error& error) {
            report.add_difference(conf.string(), std::string("manager for ") + language,
                                  std::string("unchanged; its components are unknown: ") + error.what());
        }
        for (const auto& component : other.components)
            report.add_difference(component.origin, component.name + " in " + language,
                                  std::string("stays in OpenRTM-aist's manager for ") + language +
                                      "; start that manager as before; the ports are connected by CORBA");
    }
}

// Shares all RTCs on one link, in their order of creation.
void add_interceptor(RtmSetup& setup, const std::string& link) {
    const std::string names =
        text::join(setup.components, ";", [](const auto& component) { return component.name; });
    setup.modules.emplace_back("InterceptorComp.so");
    setup.components.push_back({"InterceptorComp?link=" + link + (names.empty() ? "" : "&rtc=" + names),
                                "InterceptorComp", "InterceptorComp0", ""});
}

void write_setup(const RtmSetup& setup, ImportReport& report) {
    write_file(setup.output / "rtc.conf", setup.text("tandem rtm import"));
    report.add_file(setup.output / "rtc.conf");
    copy_settings_files(setup, report);
}

/// `system`: the RTSystem profile; empty if there is none.
void write_import(RtmSetup& setup, const fs::path& system, const RtmImportOptions& options,
                  ImportReport& report) {
    if (!setup.conf.empty()) {
        read_rtc_conf(setup, report);
        check_modules(setup, report);
        tell_other_languages(setup, report);
    } else {
        setup.settings.push_back({"manager.shutdown_auto", "NO", ""});
        report.add_difference(
            system.string(), "no rtc.conf",
            "RTCs are in no name server and can be reached only from this machine; for OpenRTM-aist's "
            "behaviour, set corba.nameservers: localhost and corba.endpoints: all");
    }
    if (!system.empty()) add_system(setup, read_rts_profile(system), options.activate, report);
    if (setup.components.empty())
        report.add_task((setup.conf.empty() ? system : setup.conf).string(), "no RTC is created here",
                        "add RTCs to manager.components.precreate in " +
                            (setup.output / "rtc.conf").string());
    if (!options.link.empty()) add_interceptor(setup, options.link);
    write_setup(setup, report);
}

} // namespace

void copy_settings_files(const RtmSetup& setup, ImportReport& report) {
    for (const auto& [from, name] : setup.files) {
        if (fs::exists(setup.output / name)) continue; // two keys can name the same file
        fs::copy_file(from, setup.output / name);
        report.add_file(setup.output / name);
    }
}

int rtm_import(const RtmImportOptions& options) {
    if (!fs::is_directory(options.folder))
        throw std::runtime_error(options.folder.string() +
                                 " is not a folder: expected an installation of OpenRTM-aist");
    if (!options.link.empty()) shm::check_link_name(options.link);
    RtmSetup setup;
    setup.installation = fs::canonical(options.folder);
    require_conf_path(setup.installation);
    setup.conf = options.conf.empty() ? find_rtc_conf(setup.installation) : fs::canonical(options.conf);
    const fs::path system =
        options.system.empty() ? find_rts_profile(setup.installation) : fs::canonical(options.system);
    if (setup.conf.empty() && system.empty())
        throw std::runtime_error(
            options.folder.string() +
            " has neither an rtc.conf (also looked for: rtcd.conf, conf/rtc_cpp.conf, conf/rtc.conf) nor an "
            "RTSystem profile; name one with --rtc-conf FILE or --system FILE");
    ImportFolder folder(options.output, options.folder, "rtm");
    setup.output = folder.path();
    ImportReport report;
    folder.complete(report, [&] { write_import(setup, system, options, report); });
    report.print(folder.output(), "host/rtm/DIFFERENCES.md", "rtc.conf files", options.json);
    return 0;
}

} // namespace tandem::command

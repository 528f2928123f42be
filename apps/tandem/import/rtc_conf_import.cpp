// SPDX-License-Identifier: Apache-2.0
// Converts each setting of an rtc.conf for OpenRTM-aist's manager.
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/import/rtm_setup.hpp"

#include "host/rtm/runtime/configuration/component_arguments.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"

#include <coil/stringutil.h>
#include <rtm/Manager.h>

#include <algorithm>
#include <charconv>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns the line of an origin FILE:LINE.
int line_of(const std::string& origin) {
    int line = 0;
    const auto colon = origin.rfind(':');
    if (colon != std::string::npos) std::from_chars(&origin[colon + 1], origin.data() + origin.size(), line);
    return line;
}

std::vector<ConfSetting> read_in_order(const fs::path& conf) {
    coil::Properties properties;
    RTC::SettingOrigins origins;
    RTC::read_conf_file(conf, properties, &origins);
    std::vector<ConfSetting> settings;
    for (const auto& [key, origin] : origins)
        if (std::string value = properties.getProperty(key); !value.empty())
            settings.push_back({key, value, origin});
    std::stable_sort(settings.begin(), settings.end(),
                     [](const auto& a, const auto& b) { return line_of(a.origin) < line_of(b.origin); });
    return settings;
}

// Returns the error in a rate of a component's own settings, with which rtm_host would not create the component; "" for
// other settings.
std::string rate_error(const std::string& key, const std::string& value) {
    for (const char* section : {"exec_cxt.", "ec."}) {
        const auto at = key.starts_with(section) ? 0 : key.find(std::string(".") + section);
        if (at == std::string::npos) continue;
        const std::string setting = key.substr(at == 0 ? 0 : at + 1);
        const RTC::ConfKey* known = RTC::find_conf_key(setting);
        if (known == nullptr || known->value != RTC::ConfKey::hertz) continue;
        const std::string error = RTC::setting_error(setting, value);
        return error.empty() ? "" : key + error.substr(error.starts_with(setting) ? setting.size() : 0);
    }
    return "";
}

// Returns whether the setting asks for a context type of OpenRTM-aist that is not available.
bool asks_for_unavailable_context(const std::string& key, const std::string& value) {
    if (!key.ends_with("exec_cxt.periodic.type") && !key.ends_with("execution_contexts")) return false;
    const auto entries = split_list(value);
    return std::any_of(entries.begin(), entries.end(), [](const std::string& entry) {
        const std::string type = coil::eraseBothEndsBlank(entry.substr(0, entry.find('(')));
        return type == "ArtExecutionContext" || type == "LogicalTimeTriggeredEC" ||
               type == "MultilayerCompositeEC";
    });
}

constexpr const char* other_context = "not available: left out, so PeriodicExecutionContext is used";

/// Adds the settings of one rtc.conf to a set-up.
class ConfReader {
  public:
    ConfReader(RtmSetup& setup, ImportReport& report) : setup_(setup), report_(report) {}

    void read() {
        for (const auto& setting : read_in_order(setup_.conf)) take(setting);
        tell_defaults();
        check_connections();
        check_activations();
    }

  private:
    void differs(const ConfSetting& setting, const std::string& here) {
        const bool is_secret = setting.key.find("password") != std::string::npos;
        report_.add_difference(
            setting.origin, setting.key + ": " + (is_secret ? "***" : RTC::printable(setting.value)), here);
    }
    void keep(const ConfSetting& setting, const std::string& value) {
        setup_.settings.push_back({setting.key, value, setting.origin});
    }

    void take(const ConfSetting& setting) {
        const std::string& key = setting.key;
        const RTC::ConfKey* known = RTC::find_conf_key(key);
        if (known != nullptr && !known->used) return differs(setting, "left out: it has no effect here");
        if (take_list(setting)) return;
        if (std::string error = RTC::setting_error(key, setting.value); !error.empty()) {
            // OpenRTM-aist replaces an invalid value by the default; rtm_host reports an error.
            if (known != nullptr) throw RTC::ManagerError(setting.origin + ": " + error);
            differs(setting, error + " rtm_host warns of it and ignores it");
        }
        if (const auto error = rate_error(key, setting.value); !error.empty())
            throw RTC::ManagerError(setting.origin + ": " + error);
        if (key.ends_with(".config_file")) return take_config_file(setting);
        if (key == "logger.file_name") return take_log_files(setting);
        if (asks_for_unavailable_context(key, setting.value)) return differs(setting, other_context);
        tell_other_meaning(setting);
        keep(setting, setting.value);
    }

    // Handles the settings that this command changes entry by entry.
    bool take_list(const ConfSetting& setting) {
        const auto entries = split_list(setting.value);
        const auto append = [&](std::vector<std::string>& list) {
            list.insert(list.end(), entries.begin(), entries.end());
            return true;
        };
        if (setting.key == "manager.modules.load_path" || setting.key == "manager.modules.C++.load_paths") {
            for (const auto& folder : entries) take_folder(setting, folder);
            return true;
        }
        if (setting.key == "manager.modules.preload" || setting.key == "manager.preload.modules") {
            setup_.modules_origin = setting.origin;
            return append(setup_.modules);
        }
        if (setting.key == "manager.components.precreate") {
            for (const auto& entry : entries) take_component(setting, entry);
            return true;
        }
        if (setting.key == "manager.components.preconnect") {
            origins_[0] = setting.origin;
            for (const auto& entry : entries)
                if (entry.find("://") != std::string::npos)
                    report_.add_difference(setting.origin, "preconnect " + entry,
                                           "made again each time the other process returns, not only once");
            return append(setup_.connections);
        }
        if (setting.key == "manager.components.preactivation") {
            origins_[1] = setting.origin;
            return append(setup_.activations);
        }
        return false;
    }

    void take_folder(const ConfSetting& setting, const std::string& folder) {
        if (folder.find('$') != std::string::npos) return setup_.load_path.emplace_back(folder), void();
        if (const auto found = setup_.resolve(folder); !found.empty())
            return setup_.load_path.push_back(found);
        report_.add_difference(setting.origin, "load_path " + folder, "left out: the folder does not exist");
    }

    void take_component(const ConfSetting& setting, const std::string& entry) {
        RTC::ComponentArguments arguments;
        try {
            arguments = RTC::parse_component_arguments(entry);
        } catch (const RTC::ManagerError& error) {
            throw RTC::ManagerError(setting.origin + ": " + error.what());
        }
        const std::string type = arguments.id.getProperty("implementation_id"),
                          language = arguments.id.getProperty("language");
        if (!language.empty() && language != "C++")
            return report_.add_difference(
                setting.origin, "precreate " + entry,
                "left out: rtm_host runs C++, not " + language +
                    "; run it in OpenRTM-aist's manager and connect its ports by rtcname://");
        const std::string& given = arguments.properties.getProperty("instance_name");
        const std::string name = given.empty() ? setup_.next_name(type) : given;
        if (setup_.creates(name))
            return report_.add_difference(setting.origin, "precreate " + entry,
                                          "left out: another entry creates " + name);
        setup_.components.push_back({usable_entry(setting, entry), type, name, setting.origin});
    }

    // Returns the entry without the arguments that rtm_host would refuse.
    std::string usable_entry(const ConfSetting& setting, const std::string& entry) {
        const auto question = entry.find('?');
        if (question == std::string::npos) return entry;
        std::string kept;
        for (const auto& argument : coil::split(entry.substr(question + 1), "&", true)) {
            const std::string key = coil::eraseBothEndsBlank(argument.substr(0, argument.find('='))),
                              value = coil::eraseBothEndsBlank(argument.substr(argument.find('=') + 1));
            if (const auto error = rate_error(key, value); !error.empty())
                throw RTC::ManagerError(setting.origin + ": precreate " + entry + ": " + error);
            if (key == "manager_name" || key == "manager_address")
                report_.add_difference(setting.origin, "precreate " + entry,
                                       key + " left out: there are no slave managers, so it is created here");
            else if (asks_for_unavailable_context(key, value))
                report_.add_difference(setting.origin, "precreate " + entry,
                                       key + " " + value + ": " + other_context);
            else
                kept += (kept.empty() ? "?" : "&") + argument;
        }
        return entry.substr(0, question) + kept;
    }

    // Relative names refer to rtcd's working directory, which differs from that of rtm_host.
    void take_config_file(const ConfSetting& setting) {
        const fs::path found = setup_.resolve(setting.value);
        if (found.empty() && setting.value.find('$') == std::string::npos)
            return differs(
                setting,
                "left out: the file does not exist; the component uses its defaults, as with OpenRTM-aist");
        if (found.empty()) return keep(setting, setting.value);
        check_config_file(found, setting.key.substr(0, setting.key.rfind('.')));
        std::string name = found.filename().string();
        for (int number = 2; name == "rtc.conf" || is_other_file(name, found); ++number)
            name = found.stem().string() + "-" + std::to_string(number) + found.extension().string();
        setup_.files.emplace_back(found, name);
        keep(setting, name);
        report_.add_difference(setting.origin, setting.key,
                               "uses the copy " + (setup_.output / name).string() + "; edit the copy");
    }
    // A setting of `component` in rtc.conf overrides its file, so the copy needs no change.
    void check_config_file(const fs::path& file, const std::string& component) {
        coil::Properties settings;
        RTC::SettingOrigins origins;
        RTC::read_conf_file(file, settings, &origins);
        for (const auto& [key, origin] : origins) {
            const std::string& value = settings.getProperty(key);
            if (const auto error = rate_error(key, value); !error.empty())
                throw RTC::ManagerError(origin + ": " + error);
            if (!asks_for_unavailable_context(key, value)) continue;
            report_.add_difference(origin, key + ": " + value, other_context);
            setup_.settings.push_back({component + "." + key, "PeriodicExecutionContext", origin});
        }
    }
    bool is_other_file(const std::string& name, const fs::path& file) const {
        return std::any_of(setup_.files.begin(), setup_.files.end(),
                           [&](const auto& each) { return each.second == name && each.first != file; });
    }

    void take_log_files(const ConfSetting& setting) {
        std::string value;
        for (const auto& file : split_list(setting.value)) {
            const fs::path path(file);
            if (path.is_absolute() || !path.has_parent_path()) {
                value += (value.empty() ? "" : ", ") + file;
                continue;
            }
            value += (value.empty() ? "" : ", ") + path.filename().string();
        }
        if (value != setting.value || value.find('/') == std::string::npos)
            if (value != "stdout" && value != "stderr")
                differs(setting, "the log goes to " + value + " in " + setup_.output.string());
        keep(setting, value);
    }

    void tell_other_meaning(const ConfSetting& setting) {
        if (setting.key.ends_with("exec_cxt.periodic.type") && setting.value == "RTPreemptEC")
            differs(setting,
                    "the same as PeriodicExecutionContext; its priority is exec_cxt.periodic.priority");
        if (setting.key == "manager.components.naming_policy" &&
            coil::normalize(setting.value) != "process_unique")
            differs(setting, "names are unique in this process only");
        if (setting.key == "manager.is_master" && coil::toBool(setting.value, "YES", "NO", false))
            differs(setting, "port 2810 is open only at 127.0.0.1 (for every address, set corba.endpoints: "
                             "all); there are no slave managers");
    }

    // Reports defaults that differ, because the file does not mention them.
    void tell_defaults() {
        const std::string file = setup_.conf.string();
        if (setup_.find("corba.endpoints") == nullptr && setup_.find("corba.endpoint") == nullptr)
            report_.add_difference(file, "no corba.endpoints",
                                   "only this user's processes on this machine can reach the RTCs; to open "
                                   "every address as before, set corba.endpoints: all");
        const ConfSetting* naming = setup_.find("naming.enable");
        const bool no_names = naming != nullptr && !coil::toBool(naming->value, "YES", "NO", true);
        if (setup_.find("corba.nameservers") == nullptr && !no_names)
            report_.add_difference(file, "no corba.nameservers",
                                   "no name server is used; to use that of localhost as before, set "
                                   "corba.nameservers: localhost");
        if (setup_.find("logger.file_name") == nullptr)
            report_.add_difference(file, "no logger.file_name",
                                   "the log goes to standard error, not to ./rtcPID.log");
    }

    // rtm_host exits at an entry that it cannot apply; OpenRTM-aist logs it and continues.
    void check_connections() {
        for (auto& entry : setup_.connections) entry = with_usable_interface(entry);
        std::erase_if(setup_.connections, [&](const std::string& entry) {
            const std::string error = connection_error(entry);
            if (!error.empty())
                report_.add_difference(origins_[0], "preconnect " + entry, "left out: " + error);
            return !error.empty();
        });
    }

    void check_activations() {
        std::erase_if(setup_.activations, [&](const std::string& name) {
            if (name.find("://") != std::string::npos || setup_.creates(name)) return false;
            report_.add_difference(origins_[1], "preactivation " + name,
                                   "left out: no entry of precreate creates " + name);
            return true;
        });
    }

    // Returns why rtm_host would refuse the entry; "" if it would not.
    std::string connection_error(const std::string& entry) const {
        const auto parameters = entry.find_first_of("?(");
        for (const auto& parameter :
             coil::split(parameters == std::string::npos ? "" : entry.substr(parameters + 1), "&", true))
            if (const auto equals = parameter.find('='); equals == std::string::npos || equals == 0)
                return "expected key=value, found " + parameter;
        for (const auto& port : ports_of(entry)) {
            if (port.find("://") != std::string::npos) continue;
            const auto dot = port.rfind('.');
            if (dot == std::string::npos) return "expected COMPONENT.PORT, found " + port;
            if (!setup_.creates(port.substr(0, dot)))
                return "no entry of precreate creates " + port.substr(0, dot);
        }
        return "";
    }

    // Replaces an interface type that neither rtm_host nor a module in preload has.
    std::string with_usable_interface(const std::string& entry) {
        static const std::string key = "interface_type=";
        const auto at = entry.find(key);
        if (at == std::string::npos) return entry;
        const auto begin = at + key.size(), end = std::min(entry.find_first_of("&)", begin), entry.size());
        const std::string type = coil::eraseBothEndsBlank(entry.substr(begin, end - begin));
        if (has_interface_type(setup_, type)) return entry;
        report_.add_difference(origins_[0], "preconnect " + entry,
                               "interface_type " + type + " is not available: corba_cdr");
        return entry.substr(0, begin) + "corba_cdr" + entry.substr(end);
    }

    // Returns the ports of A.p?port=B.q&..., or of A.p:B.q(...) as in 1.x.
    static std::vector<std::string> ports_of(const std::string& entry) {
        const auto question = entry.find('?');
        if (question == std::string::npos) return coil::split(entry.substr(0, entry.find('(')), ":");
        std::vector<std::string> ports{coil::eraseBothEndsBlank(entry.substr(0, question))};
        for (const auto& parameter : coil::split(entry.substr(question + 1), "&", true))
            if (const auto equals = parameter.find('='); equals != std::string::npos)
                if (const auto key = coil::eraseBothEndsBlank(parameter.substr(0, equals));
                    key.starts_with("port") && key.find_first_not_of("0123456789", 4) == std::string::npos)
                    ports.push_back(coil::eraseBothEndsBlank(parameter.substr(equals + 1)));
        return ports;
    }

    RtmSetup& setup_;
    ImportReport& report_;
    std::string origins_[2]; // origins of preconnect and preactivation
};

} // namespace

fs::path find_rtc_conf(const fs::path& installation) {
    for (const char* name : {"rtc.conf", "rtcd.conf", "conf/rtc_cpp.conf", "conf/rtc.conf"})
        if (is_there(installation / name)) return fs::absolute(installation / name).lexically_normal();
    return {};
}

void read_rtc_conf(RtmSetup& setup, ImportReport& report) { ConfReader(setup, report).read(); }

} // namespace tandem::command

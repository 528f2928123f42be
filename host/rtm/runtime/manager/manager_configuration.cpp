// SPDX-License-Identifier: Apache-2.0
// Command line, rtc.conf, names.
#include "host/rt/thread.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <cstdlib>
#include <unistd.h>

namespace RTC {
namespace {

const char* const defaults[] = {"config.version",
                                openrtm_version,
                                "openrtm.name",
                                openrtm_name,
                                "openrtm.version",
                                openrtm_version,
                                "manager.instance_name",
                                "manager",
                                "manager.name",
                                "manager",
                                "manager.modules.load_path",
                                "./",
                                "manager.modules.abs_path_allowed",
                                "YES",
                                "manager.is_master",
                                "NO",
                                "manager.shutdown_on_nortcs",
                                "YES",
                                "manager.shutdown_auto",
                                "YES",
                                "manager.auto_shutdown_duration",
                                "20.0",
                                "logger.enable",
                                "YES",
                                "logger.log_level",
                                "INFO",
                                "naming.formats",
                                "%h.host_cxt/%n.rtc",
                                "corba.endpoints",
                                "127.0.0.1:",
                                "exec_cxt.periodic.type",
                                "PeriodicExecutionContext",
                                "exec_cxt.periodic.rate",
                                "1000",
                                "exec_cxt.sync_transition",
                                "YES",
                                "exec_cxt.transition_timeout",
                                "0.5",
                                ""};

std::string host_name() {
    char name[256] = "localhost";
    gethostname(name, sizeof name - 1);
    return name;
}

// What the command line says, before the file is read: it wins over the file.
struct CommandLine {
    std::string file;
    bool file_may_be_missing = false;
    coil::Properties settings;
    SettingOrigins places;
    void set(const std::string& option, const std::string& key, const std::string& value) {
        settings.setProperty(key, value);
        places[key] = "option " + option;
    }
};

CommandLine parse(int argc, char** argv) {
    CommandLine line;
    auto value = [&](int& i, const std::string& option) -> std::string {
        if (i + 1 >= argc) throw ManagerError("option " + option + " needs a value");
        return argv[++i];
    };
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "-f")
            line.file = value(i, option);
        else if (option == "-o") {
            const std::string setting = value(i, option);
            const std::size_t at = setting.find_first_of(":=");
            if (at == std::string::npos || at == 0)
                throw ManagerError("option -o: expected key:value, found " + setting);
            line.set(option, coil::eraseBothEndsBlank(setting.substr(0, at)),
                     coil::eraseBothEndsBlank(setting.substr(at + 1)));
        } else if (option == "-p") {
            const std::string port = value(i, option);
            int number = -1;
            if (!coil::stringTo(number, port.c_str()) || number < 0 || number > 65535)
                throw ManagerError("option -p: expected a TCP port, found " + port);
            line.set(option, "corba.endpoints", "127.0.0.1:" + port);
        } else if (option == "-a")
            line.set(option, "manager.corba_servant", "NO");
        else if (option == "-i")
            line.file_may_be_missing = true;
        else if (option == "-d")
            for (const auto& [key, word] : {std::pair("manager.is_master", "YES"),
                                            {"manager.shutdown_auto", "NO"},
                                            {"manager.shutdown_on_nortcs", "NO"}})
                line.set(option, key, word);
        // Others are what a component's own main() understands.
    }
    return line;
}

std::string default_file() {
    if (const char* named = std::getenv("RTC_MANAGER_CONFIG")) return named;
    for (const char* file : {"./rtc.conf", "/etc/rtc.conf", "/etc/rtc/rtc.conf"})
        if (std::filesystem::exists(file)) return file;
    return "";
}

void set_up_logger(const coil::Properties& config, Logger& log) {
    if (!coil::toBool(config.getProperty("logger.enable"), "YES", "NO", true)) {
        log.setLevel("SILENT");
        return;
    }
    const std::string level = coil::toUpper(config.getProperty("logger.log_level"));
    log.setLevel(level == "NORMAL" || level.empty() ? "INFO" : level.c_str());
    if (!config.getProperty("logger.date_format").empty())
        log.setDateFormat(config.getProperty("logger.date_format").c_str());
    coil::Properties self;
    self.setProperty("instance_name", config.getProperty("manager.instance_name"));
    for (const auto& format : coil::split(config.getProperty("logger.file_name"), ",", true)) {
        const std::string name = format_name(format, self, config);
        if (!Logger::addOutput(name)) throw ManagerError("logger.file_name: " + name + " cannot be written");
    }
}

// Before there are other threads: they inherit it.
void pin_process(const std::string& processors, Logger& rtclog) {
    std::vector<int> cpus;
    if (processors.empty() || !coil::stringTo(cpus, processors.c_str())) return;
    if (const auto notice = tandem::rt::pin_this_thread("manager", cpus)) RTC_WARN(("%s", notice->c_str()));
}

} // namespace

void read_configuration(Manager::Impl& impl, int argc, char** argv) {
    impl.config.setDefaults(defaults);
    CommandLine line = parse(argc, argv);
    const std::string file = line.file.empty() ? default_file() : line.file;
    SettingOrigins places;
    if (!file.empty() && !(line.file_may_be_missing && !std::filesystem::exists(file))) {
        read_conf_file(file, impl.config, &places);
        impl.conf_file = file;
        impl.config.setProperty("config_file", file);
    }
    impl.config << line.settings;
    for (const auto& [key, place] : line.places) places[key] = place;
    const auto unknown = check_settings(impl.config, places);
    impl.config.setProperty("os.hostname", host_name());
    impl.config.setProperty("manager.pid", std::to_string(getpid()));
    set_up_logger(impl.config, impl.log);
    Logger& rtclog = impl.log;
    for (const auto& one : unknown) RTC_WARN(("%s", one.c_str()));
    if (const std::string policy =
            coil::normalize(impl.config.getProperty("manager.components.naming_policy"));
        policy == "ns_unique" || policy == "node_unique")
        RTC_WARN(("%s: manager.components.naming_policy %s: names are made unique in this process only",
                  places["manager.components.naming_policy"].c_str(), policy.c_str()));
    pin_process(impl.config.getProperty("manager.cpu_affinity"), rtclog);
}

std::string format_name(const std::string& format, const coil::Properties& component,
                        const coil::Properties& config) {
    std::string out;
    for (std::size_t i = 0; i < format.size(); ++i) {
        if (format[i] == '$') { // $NAME or ${NAME}
            const std::size_t end = format.find_first_of(format.compare(i, 2, "${") == 0 ? "}" : "./%-", i);
            const std::string variable = format.substr(i, end == std::string::npos ? end : end - i);
            const bool braces = variable.compare(0, 2, "${") == 0;
            if (const char* value = std::getenv(variable.substr(braces ? 2 : 1).c_str())) out += value;
            i += variable.size() - (braces && end != std::string::npos ? 0 : 1);
            continue;
        }
        if (format[i] != '%' || i + 1 == format.size()) {
            out += format[i];
            continue;
        }
        switch (format[++i]) {
        case 'n':
            out += component.getProperty("instance_name");
            break;
        case 't':
        case 'm':
            out += component.getProperty("type_name");
            break;
        case 'v':
            out += component.getProperty("version");
            break;
        case 'V':
            out += component.getProperty("vendor");
            break;
        case 'c':
            out += component.getProperty("category");
            break;
        case 'i':
            out += component.getProperty("implementation_id");
            break;
        case 'N': { // the number
            const std::string name = component.getProperty("instance_name");
            const std::string id = component.getProperty("implementation_id");
            out += name.compare(0, id.size(), id) == 0 ? name.substr(id.size()) : name;
            break;
        }
        case 'h':
            out += config.getProperty("os.hostname");
            break;
        case 'M':
            out += config.getProperty("manager.name");
            break;
        case 'p':
            out += config.getProperty("manager.pid");
            break;
        default:
            out += format[i];
        }
    }
    return out;
}

ComponentArguments parse_component_arguments(const std::string& args) {
    ComponentArguments parsed;
    const std::size_t question = args.find('?');
    const std::string type = coil::eraseBothEndsBlank(args.substr(0, question));
    const auto parts = coil::split(type, ":");
    if (parts.size() == 6 && parts[0] == "RTC") {
        const char* const keys[] = {"", "vendor", "category", "implementation_id", "language", "version"};
        for (std::size_t i = 1; i < 6; ++i) parsed.id.setProperty(keys[i], parts[i]);
    } else if (parts.size() == 1 && !type.empty()) {
        parsed.id.setProperty("implementation_id", type);
    } else {
        throw ManagerError("`" + args + "` names no component type; expected Name or Name?key=value&...");
    }
    if (question == std::string::npos) return parsed;
    for (const auto& param : coil::split(args.substr(question + 1), "&", true)) {
        const std::size_t equals = param.find('=');
        if (equals == std::string::npos || equals == 0)
            throw ManagerError("`" + args + "`: expected key=value, found `" + param + "`");
        parsed.properties.setProperty(coil::eraseBothEndsBlank(param.substr(0, equals)),
                                      coil::eraseBothEndsBlank(param.substr(equals + 1)));
    }
    return parsed;
}

} // namespace RTC

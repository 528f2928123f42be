// SPDX-License-Identifier: Apache-2.0
// The options of OpenRTM-aist's ManagerConfig::parseArgs(): -f -o -p -d -i -a.
#include "host/rtm/runtime/configuration/command_line.hpp"
#include <coil/stringutil.h>
#include <rtm/Manager.h>
#include <utility>

namespace RTC {
namespace {

// -o key:value; `key=value` is understood as well.
void parse_setting_option(CommandLine& line, const std::string& setting) {
    const std::size_t separator = setting.find_first_of(":=");
    if (separator == std::string::npos || separator == 0)
        throw ManagerError("option -o: expected key:value, found " + setting);
    line.set("-o", coil::eraseBothEndsBlank(setting.substr(0, separator)),
             coil::eraseBothEndsBlank(setting.substr(separator + 1)));
}

// -p PORT. The endpoint stays on the loopback interface; corba.endpoints opens others.
void parse_port_option(CommandLine& line, const std::string& port) {
    int number = -1;
    if (!coil::stringTo(number, port.c_str()) || number < 0 || number > 65535)
        throw ManagerError("option -p: expected a TCP port, 0 to 65535, found " + port);
    line.set("-p", "corba.endpoints", "127.0.0.1:" + port);
}

} // namespace

void CommandLine::set(const std::string& option, const std::string& key, const std::string& value) {
    settings.setProperty(key, value);
    origins[key] = "option " + option;
}

CommandLine parse_command_line(int argc, char** argv) {
    CommandLine line;
    auto next_argument = [&](int& i, const std::string& option) -> std::string {
        if (i + 1 >= argc) throw ManagerError("option " + option + " needs a value");
        return argv[++i];
    };
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "-f")
            line.conf_file = next_argument(i, option);
        else if (option == "-o")
            parse_setting_option(line, next_argument(i, option));
        else if (option == "-p")
            parse_port_option(line, next_argument(i, option));
        else if (option == "-a")
            line.set(option, "manager.corba_servant", "NO");
        else if (option == "-i")
            line.conf_file_may_be_missing = true;
        else if (option == "-d") // a master manager waits for components to be created by tools
            for (const auto& [key, value] : {std::pair("manager.is_master", "YES"),
                                             {"manager.shutdown_auto", "NO"},
                                             {"manager.shutdown_on_nortcs", "NO"}})
                line.set(option, key, value);
    }
    return line;
}

} // namespace RTC

// SPDX-License-Identifier: Apache-2.0
#include "host/options/rtm_host_options.hpp"

#include "host/options/number_check.hpp"
#include "host/options/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <tandem_version.hpp>

namespace tandem::options {

// -f -o -p -d -i -a are the options of OpenRTM-aist's managers. The long options are Tandem's.
std::optional<RtmHostOptions> parse_rtm_host_options(int argc, char** argv, int& exit_code) {
    RtmHostOptions options;
    CLI::App cli{"Runs the RT-Components that an rtc.conf names"};
    cli.set_version_flag("--version", std::string("rtm_host ") + tandem::version);
    cli.add_option("-f", options.conf_file,
                   "configuration file (default: $RTC_MANAGER_CONFIG, or the first of ./rtc.conf, "
                   "/etc/rtc.conf and /etc/rtc/rtc.conf)");
    cli.add_option("-o", options.settings,
                   "a setting of rtc.conf, KEY:VALUE; overrides the file (repeatable)")
        ->allow_extra_args(false);
    cli.add_option("-p", options.port, "TCP port of the CORBA endpoint on the loopback interface");
    cli.add_flag("-d", options.master, "master manager: port 2810, and keep running without components");
    cli.add_flag("-i", options.conf_file_may_be_missing, "ignore a configuration file that does not exist");
    cli.add_flag("-a", options.no_corba_servant, "do not offer the manager as a CORBA object");
    cli.add_option("--lockstep", options.lockstep_socket,
                   "path of a Unix socket at which a driver requests each cycle; nothing runs on timers");
    cli.add_option("--plugin-path", options.plugin_path,
                   "additional folder of component libraries (repeatable)")
        ->allow_extra_args(false);
    cli.add_option("--grace", options.grace_s,
                   "time limit for each callback of a component when the host ends, in seconds (10)")
        ->check(number_between(0.01, 3600.));
    add_library_probe_options(cli, options.probe);
    add_real_time_options(cli, options.real_time);
    cli.footer("Examples:\n  $ rtm_host -f rtc.conf\n  $ rtm_host -d -o logger.log_level:DEBUG");
    const auto result = parse(cli, argc, argv);
    exit_code = result.value_or(0);
    return result ? std::nullopt : std::optional(options);
}

} // namespace tandem::options

// SPDX-License-Identifier: Apache-2.0
#include "host/options/opros_host_options.hpp"

#include "host/options/number_check.hpp"
#include "host/options/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <tandem_version.hpp>

namespace tandem::options {

std::optional<OprosHostOptions> parse_opros_host_options(int argc, char** argv, int& exit_code) {
    OprosHostOptions options;
    CLI::App cli("Runs an OPRoS application: its components, from their libraries and profiles.");
    cli.set_version_flag("--version", std::string("opros_host ") + tandem::version);
    cli.add_option("application", options.application, "Application profile (XML)")->required();
    cli.add_option("--plugin-path", options.plugin_dirs, "Folder with component libraries (repeatable)")
        ->allow_extra_args(false);
    cli.add_option("--lockstep", options.lockstep_socket,
                   "Path of a Unix socket at which a driver requests each cycle; nothing runs on timers");
    cli.add_option("--node", options.node,
                   "Run only the components with this <node_id>, and those without one (the profile's "
                   "<local_node_id>)")
        ->type_name("ID");
    cli.add_flag(
        "--strict", options.strict,
        "End if a component cannot be loaded, initialized or started, or a connection cannot be made");
    cli.add_option("--grace", options.grace_s,
                   "Time limit for each callback of a component when the host ends, in seconds (10)")
        ->check(number_between(0.01, 3600.));
    cli.add_flag("--stats", options.stats, "Print the executors' ticks and overruns at the end");
    add_library_probe_options(cli, options.probe);
    add_real_time_options(cli, options.real_time);
    cli.footer("Examples:\n  $ opros_host robot.xml\n  $ opros_host robot.xml --strict --lock-memory");
    const auto result = parse(cli, argc, argv);
    exit_code = result.value_or(0);
    return result ? std::nullopt : std::optional(options);
}

} // namespace tandem::options

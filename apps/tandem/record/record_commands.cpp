// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem record`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/record/commands.hpp"

#include <memory>

namespace tandem::command {

void add_recording_options(CLI::App& command, RecordingOptions& options) {
    command.add_option("-o,--output", options.file, "new file to write (NAME-DATE-TIME.mcap)")
        ->type_name("FILE");
    command.add_option("--compression", options.compression, "of the file (lz4)")
        ->check(CLI::IsMember({"none", "lz4", "zstd"}));
    command.add_option("--duration", options.duration_s, "end after so long")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber);
}

void add_record_commands(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<RecordOptions>();
    CLI::App* command = add_command(
        tandem, "record", "Records the messages and service calls of links into an MCAP file",
        "Copies the messages in shared memory beside their receivers: neither host notices, waits or\n"
        "is told. Hosts may start, stop and restart meanwhile. Ends with Ctrl-C or SIGTERM. A killed\n"
        "recording can be read up to its last half second.\n"
        "Each port is a channel /LINK/PORT with its type as IDL; /LINK/tandem/drops counts what\n"
        "receivers did not get, and what this program did not. The hosts' command lines, profiles and\n"
        "rtc.conf are stored with it.\n"
        "Service calls are /LINK/PORT/OPERATION/request, reply and failure. A call whose slot in\n"
        "shared memory was used again before this program looked is counted and not recorded; with\n"
        "TANDEM_CALL_HISTORY=1 in the environment of the hosts there is time for 15 more calls.\n"
        "tandem bag info FILE shows what is in a file; Foxglove, Lichtblick and PlotJuggler open it.");
    command->add_option("LINK", options->links, "names of links")->required();
    command->add_option("--port", options->ports, "only these ports")->type_name("PORT");
    add_recording_options(*command, *options);
    command->callback([=, &selected] { selected = [options] { return record(*options); }; });
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem record`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/record/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {

void add_recording_options(CLI::App& command, RecordingOptions& options) {
    command.add_option("-o,--output", options.file, "new file to create (NAME-DATE-TIME.mcap)")
        ->type_name("FILE");
    command.add_option("--compression", options.compression, "compression of the file (lz4)")
        ->check(CLI::IsMember({"none", "lz4", "zstd"}));
    command.add_option("--duration", options.duration_s, "end after this time")
        ->type_name("SECONDS")
        ->check(options::positive_number());
}

void add_record_commands(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<RecordOptions>();
    CLI::App* command = add_command(
        tandem, "record", "Records the messages and service calls of links to an MCAP file",
        R"(Copies the messages from shared memory without notifying or delaying either host. Hosts may start,
stop and restart during the recording. Ends with Ctrl-C, SIGTERM or SIGHUP. If the recorder is killed,
the file is readable up to the last half second. A file that is not empty is not replaced.
Exit code 1 if a link or a port did not exist during the recording, or if the file cannot take all
messages.
Each port becomes a channel /LINK/PORT with its type as IDL. The channel /LINK/tandem/drops counts
the messages that receivers missed and those that the recorder missed. The hosts' command lines,
application profiles and rtc.conf are stored in the file.
Service calls become the channels /LINK/PORT/OPERATION/request, reply and failure. If a call's slot
in shared memory was reused before the recorder looked, the call is counted but not recorded. Set
TANDEM_CALL_HISTORY=1 in the environment of the hosts to keep 127 more calls readable.
tandem bag info FILE shows the contents. Foxglove, Lichtblick and PlotJuggler open the file.)");
    command->add_option("LINK", options->links, "names of links")->required();
    command->add_option("--port", options->ports, "only this port (repeatable; all ports)")
        ->type_name("PORT");
    add_recording_options(*command, *options);
    command->callback([=, &selected] { selected = [options] { return record(*options); }; });
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem bag`.
#include "apps/tandem/bag/commands.hpp"
#include "apps/tandem/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

struct BagFile {
    std::filesystem::path file;
    bool json = false;
};

void add_info(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagFile>();
    CLI::App* command = add_command(
        bag, "info", "Prints the contents of a recording and whether it is complete",
        R"(If the recorder was killed, the file is read up to its last complete record, and a line says what is missing.
Rates are messages per second between the first and the last message of the file. DROPS is the number of
messages missing between a topic's first and last message, or "-" if its messages are not numbered.
Exit code 1 if the file is not an MCAP file, or incomplete or damaged.)");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    command->add_flag("--json", options->json, "print JSON instead of text");
    command->callback(
        [=, &selected] { selected = [options] { return bag_info(options->file, options->json); }; });
}

void add_cut(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagCutOptions>();
    CLI::App* command = add_command(
        bag, "cut", "Writes a part of a recording to a new file",
        R"(Times are seconds since the first message, or RFC 3339 timestamps (2026-11-23T08:15:00.5Z).
Messages at exactly these times are included. Attachments and metadata are copied.
To repair an incomplete recording, cut it without --from and --to.
Exit code 1 if a part of the recording cannot be read; the rest is written.)");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    command->add_option("-o,--output", options->out, "file to write")->type_name("FILE")->required();
    command->add_option("--from", options->from, "time of the first message to keep (start of the file)")
        ->type_name("TIME");
    command->add_option("--to", options->to, "time of the last message to keep (end of the file)")
        ->type_name("TIME");
    command->add_option("--topic", options->topics, "only this topic (repeatable; all topics)")
        ->type_name("TOPIC");
    command->callback([=, &selected] { selected = [options] { return bag_cut(*options); }; });
}

void add_convert(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagConvertOptions>();
    CLI::App* command = add_command(
        bag, "convert", "Converts the messages of a recording to CSV or JSON",
        R"(Reads recordings made by Tandem. --json writes one line per message, in the order of arrival.
--csv writes a table of one topic with one column per number and string (tm.sec, data[0]).
An existing file is replaced, unless it is a recording.
Exit code 1 if Tandem did not make the file, or if a part of it cannot be read; the rest is
converted.)");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    auto* csv = command->add_flag("--csv", options->csv, "write a table of one topic");
    command->add_flag("--json", options->json, "write one line of JSON per message")->excludes(csv);
    command->add_option("--topic", options->topics, "only this topic (repeatable; all ports)")
        ->type_name("TOPIC");
    command->add_option("-o,--output", options->out, "file to write (standard output)")->type_name("FILE");
    command->callback([=, &selected] { selected = [options] { return bag_convert(*options); }; });
}

void add_bag_check(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagFile>();
    CLI::App* command = add_command(
        bag, "check", "Checks a recording and prints each fault on one line",
        R"(Reads the whole file. Checks every record, CRC, index and count against the MCAP specification and
the rules of mcap doctor. Warnings name content that some readers do not accept.
Exit code 1 if there is an error.)");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    command->callback([=, &selected] { selected = [options] { return bag_check(options->file); }; });
}

} // namespace

void add_bag_commands(CLI::App& tandem, Action& selected) {
    CLI::App* bag =
        tandem.add_subcommand("bag", "Inspects, cuts, converts and checks recordings (MCAP files)");
    bag->require_subcommand(1);
    add_info(*bag, selected);
    add_cut(*bag, selected);
    add_convert(*bag, selected);
    add_bag_check(*bag, selected);
}

} // namespace tandem::command

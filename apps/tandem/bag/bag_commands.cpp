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
        bag, "info", "Prints what a recording contains, and whether it is complete",
        "A file whose recorder was killed is read as far as it goes; a line says what is missing.\n"
        "Rates are messages per second from the first to the last message of the file. DROPS are the numbers "
        "that\n"
        "are missing between a topic's first and last message; \"-\" if its messages are not numbered.\n"
        "Exit code 1 if the file is no MCAP file.");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    command->add_flag("--json", options->json, "print JSON instead of text");
    command->callback(
        [=, &selected] { selected = [options] { return bag_info(options->file, options->json); }; });
}

void add_cut(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagCutOptions>();
    CLI::App* command =
        add_command(bag, "cut", "Writes a part of a recording to a new file",
                    "Times are seconds from the first message, or a date and time as RFC 3339 has it\n"
                    "(2026-11-23T08:15:00.5Z); both ends are included. Attachments and metadata are "
                    "copied. Cutting nothing\n"
                    "off mends a recording that is not complete. Exit code 1 if nothing can be written.");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    command->add_option("-o,--output", options->out, "file to write")->type_name("FILE")->required();
    command->add_option("--from", options->from, "first time (the begin)")->type_name("TIME");
    command->add_option("--to", options->to, "last time (the end)")->type_name("TIME");
    command->add_option("--topic", options->topics, "only this topic; may be repeated (all)")
        ->type_name("TOPIC");
    command->callback([=, &selected] { selected = [options] { return bag_cut(*options); }; });
}

void add_convert(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagConvertOptions>();
    CLI::App* command =
        add_command(bag, "convert", "Prints the messages of a recording by the names of their members",
                    "For recordings of tandem record. --json: a line for each message, in the order in "
                    "which they came. --csv:\n"
                    "a table of one topic, a column for each number and text (tm.sec, data[0]).\n"
                    "Exit code 1 if the file is no such recording, or a message does not fit its type.");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    auto* format = command->add_option_group("format")->require_option(1);
    format->add_flag("--csv", options->csv, "a table");
    format->add_flag("--json", options->json, "a line of JSON for each message");
    command->add_option("--topic", options->topics, "only this topic; may be repeated (all ports)")
        ->type_name("TOPIC");
    command->add_option("-o,--output", options->out, "file to write (standard output)")->type_name("FILE");
    command->callback([=, &selected] { selected = [options] { return bag_convert(*options); }; });
}

void add_bag_check(CLI::App& bag, Action& selected) {
    auto options = std::make_shared<BagFile>();
    CLI::App* command = add_command(
        bag, "check", "Prints what is wrong with a recording, a line each",
        "Reads the whole file: every record, CRC, index and count, by the specification of MCAP and the "
        "rules\n"
        "of mcap doctor. Warnings are what readers may stumble over. Exit code 1 if there is an error.");
    command->add_option("FILE", options->file, "recording, an MCAP file")->required();
    command->callback([=, &selected] { selected = [options] { return bag_check(options->file); }; });
}

} // namespace

void add_bag_commands(CLI::App& tandem, Action& selected) {
    CLI::App* bag = tandem.add_subcommand(
        "bag", "Recordings (MCAP files): look at them, cut them, convert them, check them");
    bag->require_subcommand(1);
    add_info(*bag, selected);
    add_cut(*bag, selected);
    add_convert(*bag, selected);
    add_bag_check(*bag, selected);
}

} // namespace tandem::command

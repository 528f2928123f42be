// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/shm_commands.hpp"

#include "apps/tandem/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

/// The texts of a command in --help: one line in the list of commands, and the page below its options.
struct CommandHelp {
    const char *brief, *details;
};

constexpr CommandHelp shm_help{
    "Segments of shared memory: inspect them while their hosts run, remove what dead hosts have left",
    "A segment is the file in /dev/shm through which the two hosts of a link communicate. list, info and "
    "stats\n"
    "write nothing, wake nobody and take no lock: they may be used on a running robot."};
constexpr CommandHelp list_help{
    "All segments: link, generation, size, owner, both sides, age",
    "The two sides of a segment are\n"
    "  absent   has not joined this generation yet\n"
    "  alive    has joined\n"
    "  stopped  has joined, but its process is stopped by a signal or a debugger\n"
    "  dead     has left or died; the pid is that of its process\n"
    "  held     (of a segment that cannot be read) a running process has joined it\n"
    "Segments of other users are listed but not opened; damaged ones are listed with the reason.\n"
    "Exit code 0."};
constexpr CommandHelp info_help{
    "One segment: header, sides, and every ring, call queue and blob in it",
    "States of a side: see tandem shm list --help. Exit code 1 if there is no such "
    "segment or it cannot be read."};
constexpr CommandHelp stats_help{
    "Counters of every ring and call queue, or with --watch their rates per second",
    "For a ring, since the segment was created,\n"
    "  sent = received + refused + overwritten + skipped + waiting\n"
    "  refused      the writer found no room, or the record was too long\n"
    "  overwritten  the writer dropped it to make room for a newer one\n"
    "  skipped      the reader takes a newer one instead: its queue is shorter than what waits\n"
    "  waiting      written and not read yet\n"
    "  converted    made to fit the receiver's type, as convert.PORT asks\n"
    "  undecodable  received, and no value of the port's type\n"
    "  missed       times at which no message came within deadline_ms\n"
    "and for a call queue\n"
    "  calls        made; taken by a worker; answered\n"
    "  expired      taken, but not run, because the deadline had passed\n"
    "  overload     refused, because no slot was free\n"
    "  time-out     given up by the caller at the deadline\n"
    "  cancelled    given up by the caller before it\n"
    "  in use       slots of calls that are in progress now\n"
    "of which an open call is waiting for a worker, running, or given up by its caller and still running;\n"
    "progress is what the component says that executes it (docs/joining.md).\n"
    "Times are measured on a sample of the records and calls: age is from writing to reading a record, "
    "round\n"
    "trip from a call to its reply at the caller, service the server's part of it. They are counted in\n"
    "buckets; a percentile is the upper end of its bucket, at most 25 % too long.\n"
    "Counters are read one after the other: the sum above is exact only while nothing is sent or received.\n"
    "Exit code 1 if there is no such segment or it cannot be read."};
constexpr CommandHelp clean_help{"Removes segments that no running process holds",
                                 "Prints which segments it has removed, which it has kept, and why. Damaged "
                                 "segments are removed as well;\n"
                                 "a segment that a running process holds, or of another user, never is. "
                                 "Exit code 0."};

/// Options of list, info and clean: only one of them is chosen, so they may share one object.
struct Common {
    std::string link;
    std::uint64_t generation = 0;
    bool json = false;
};

// The same words in every command.
void add_json_flag(CLI::App* command, bool& json) {
    command->add_flag("--json", json, "print JSON instead of text");
}

// LINK is not completed and not checked here: shm::observe() knows what a link's name may be.
void add_segment_options(CLI::App* command, std::string& link, std::uint64_t& generation) {
    command->add_option("LINK", link, "name of the link")->required();
    command->add_option("--generation", generation, "show this generation instead of the newest")
        ->check(CLI::PositiveNumber);
}

// Parsing runs after these functions have returned: the callbacks keep the options alive.

// --count only makes sense with --watch: CLI11 refuses it alone.
void add_stats_command(CLI::App* shm, Action& selected) {
    auto options = std::make_shared<StatsOptions>();
    CLI::App* stats = add_command(*shm, "stats", stats_help.brief, stats_help.details);
    add_segment_options(stats, options->link, options->generation);
    add_json_flag(stats, options->json);
    stats
        ->add_option("--watch", options->period_s,
                     "repeat with this period and show rates; follows the link to its next "
                     "generations; with --json, prints one line each time")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.01, 86400.0));
    stats->add_option("--count", options->count, "end --watch after this many repetitions")->needs("--watch");
    stats->callback([=, &selected] { selected = [options] { return shm_stats(*options); }; });
}

} // namespace

void add_shm_commands(CLI::App& tandem, Action& selected) {
    CLI::App* shm = add_command(tandem, "shm", shm_help.brief, shm_help.details);
    shm->require_subcommand(1);
    auto common = std::make_shared<Common>();

    CLI::App* list = add_command(*shm, "list", list_help.brief, list_help.details);
    add_json_flag(list, common->json);
    list->callback([=, &selected] { selected = [common] { return shm_list(common->json); }; });

    CLI::App* info = add_command(*shm, "info", info_help.brief, info_help.details);
    add_segment_options(info, common->link, common->generation);
    add_json_flag(info, common->json);
    info->callback([=, &selected] {
        selected = [common] { return shm_info(common->link, common->generation, common->json); };
    });

    add_stats_command(shm, selected);

    CLI::App* clean = add_command(*shm, "clean", clean_help.brief, clean_help.details);
    clean->add_option("LINK", common->link, "only segments of this link");
    add_json_flag(clean, common->json);
    clean->callback(
        [=, &selected] { selected = [common] { return shm_clean(common->link, common->json); }; });
}

} // namespace tandem::command

// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/shm_commands.hpp"

#include "apps/tandem/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {
namespace {

/// The help texts of a command: its line in the list of commands, and the text below its options.
struct CommandHelp {
    const char *brief, *details;
};

constexpr CommandHelp shm_help{
    "Inspects segments of shared memory, even while their hosts run, and removes stale ones",
    "A segment is the file in /dev/shm through which the two hosts of a link communicate. list, info and\n"
    "stats are read-only, take no lock and wake no thread. They are safe to use on a running robot."};
constexpr CommandHelp list_help{"Lists all segments: link, generation, size, owner, both sides, age",
                                R"(States of the two sides of a segment:
  absent   has not joined this generation yet
  alive    has joined
  stopped  has joined, but a signal or a debugger has stopped its process
  dead     has left or died; the pid is that of the previous process
  held     the segment cannot be read, and a running process has joined it
`pid N of another namespace`: the process runs in another container, and N is its pid there.
Segments of other users, at most 100, are listed but not opened. Damaged segments are listed with the reason.
Exit code 0.)"};
constexpr CommandHelp info_help{"Shows one segment: header, sides, and every ring, call queue and blob in it",
                                "For the states of a side, see tandem shm list --help.\n"
                                "Exit code 1 if the segment does not exist or cannot be read."};
constexpr CommandHelp stats_help{
    "Shows counters of every ring and call queue, or with --watch their rates per second",
    R"(Counters of a ring since the segment was created:
  sent = received + refused + overwritten + skipped + waiting
  refused      dropped by the sender: no room, too long, or not convertible
  overwritten  the writer dropped the record to make room for a newer one
  skipped      the reader took newer records, because its queue is shorter than the backlog
  waiting      written but not read yet
  converted    converted to the receiver's type, as configured by convert.PORT
  undecodable  received, but not a value of the port's type
  discarded    received, but the queue of a receiving port had no room for it
  missed       deadlines (deadline_ms) that passed without a message
Counters of a call queue:
  calls        made; taken by a worker; answered
  expired      taken, but not run because the deadline had passed
  overload     refused, because no slot became free before the deadline
  time-out     abandoned by the caller at the deadline
  cancelled    abandoned by the caller before the deadline
  in use       slots of calls in progress
A call in progress is waiting for a worker, running, or still running after its caller abandoned it.
Its progress is reported by the component that executes it (share/doc/tandem/docs/joining.md).
Times are measured on a sample of the records and calls:
  age          from writing to reading a record
  round trip   from a call to its reply, at the caller
  service      the part of the round trip that the server takes
Times are counted in buckets. A percentile is the upper end of its bucket, at most 25 % too high.
Counters are read one after the other: the sum above is exact only while nothing is sent or received.
Without --watch, exit code 1 if the segment does not exist or cannot be read.)"};
constexpr CommandHelp clean_help{
    "Removes segments that no running process holds",
    "Prints which segments it removed, which it kept, and why. Damaged segments are removed too. A segment\n"
    "held by a running process or owned by another user is never removed. Exit code 0."};

/// Options of list, info and clean. Only one of these commands runs, so they can share one object.
struct Common {
    std::string link;
    std::uint64_t generation = 0;
    bool json = false;
};

// All commands describe --json in the same words.
void add_json_flag(CLI::App* command, bool& json) {
    command->add_flag("--json", json, "print JSON instead of text");
}

// LINK is not checked here: shm::observe() knows which names are valid.
void add_segment_options(CLI::App* command, std::string& link, std::uint64_t& generation) {
    command->add_option("LINK", link, "name of the link")->required();
    command->add_option("--generation", generation, "show this generation instead of the newest")
        ->check(options::positive_number());
}

// CLI11 parses after these functions have returned, so the callbacks keep the options alive.

// CLI11 refuses --count without --watch.
void add_stats_command(CLI::App* shm, Action& selected) {
    auto options = std::make_shared<StatsOptions>();
    CLI::App* stats = add_command(*shm, "stats", stats_help.brief, stats_help.details);
    add_segment_options(stats, options->link, options->generation);
    add_json_flag(stats, options->json);
    stats
        ->add_option("--watch", options->period_s,
                     "show rates with this period, following the link to its next generations; with --json, "
                     "one line per period")
        ->type_name("SECONDS")
        ->check(options::number_between(0.01, 86400.0));
    stats->add_option("--count", options->count, "end --watch after printing this many times")
        ->needs("--watch");
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

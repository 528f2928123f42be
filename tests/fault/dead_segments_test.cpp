// SPDX-License-Identifier: Apache-2.0
// What killed processes leave in /dev/shm, and who removes it. Runs alone, because it would also remove the
// leftovers of other tests.
#include "host/process/run_command.hpp"
#include "shm/segment/dead_segments.hpp"
#include "tests/shm/fixture.hpp"

#include <cstdlib>
#include <fstream>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// Both sides of the link join, in one process, and are killed.
void kill_both_sides(const Link& link) {
    Child both([&] {
        const auto first = join(link, Side::first), second = join(link, Side::second);
        pause();
        return 0;
    });
    REQUIRE(eventually([&] {
        const auto files = link.files();
        return files.size() == 1 && probe_segment(files[0]).held[1];
    }));
    both.kill_now();
    REQUIRE(link.files().size() == 1);
}

} // namespace

TEST_CASE("any Tandem program of the user removes what two killed hosts have left") {
    const Link link;
    kill_both_sides(link);
    const std::string program =
        GENERATE(std::string(TANDEM_RTM_HOST " -f /nowhere/rtc.conf"), TANDEM_OPROS_HOST " /nowhere/app.xml",
                 TANDEM_PROGRAM " opros info /nowhere");
    INFO(program);
    tandem::process::run_command({"sh", "-c", program});
    CHECK(link.files().size() == 1); // TANDEM_KEEP_DEAD_SEGMENTS is set for all tests
    tandem::process::run_command({"sh", "-c", "unset TANDEM_KEEP_DEAD_SEGMENTS; exec " + program});
    CHECK(link.files().empty());
}

TEST_CASE("tandem shm shows what the killed have left and does not remove it") {
    const Link link;
    kill_both_sides(link);
    const auto list = tandem::process::run_command(
        {"sh", "-c", "unset TANDEM_KEEP_DEAD_SEGMENTS; exec " TANDEM_PROGRAM " shm list"});
    CHECK_THAT(list.output, Catch::Contains(link.name));
    CHECK(link.files().size() == 1);
}

TEST_CASE("a segment in use, and a file that is not a segment, are not removed") {
    const Link living, dead, other;
    const auto segment = join(living, Side::first);
    kill_both_sides(dead);
    std::ofstream{segment_path(other.name, 1)} << "not a segment";
    unsetenv("TANDEM_KEEP_DEAD_SEGMENTS");
    remove_dead_segments();
    CHECK(living.files().size() == 1);
    CHECK(other.files().size() == 1);
    CHECK(dead.files().empty());
}

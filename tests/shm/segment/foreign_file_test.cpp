// SPDX-License-Identifier: Apache-2.0
// Files of other users under names of segments.
#include "shm/inspect/observer.hpp"
#include "tests/shm/fixture.hpp"
#include "tests/support/skip.hpp"

#include <fcntl.h>
#include <fstream>
#include <grp.h>
#include <sys/stat.h>

using namespace tandem::shm;
using namespace tandem::shm::test;
using Catch::Contains;

namespace {

constexpr uid_t other_user = 12345;
constexpr auto only_root = "only root can make a file of another user";

/// Creates an empty file under the name of a generation, and gives it to another user. Returns false if only root could.
bool foreign_file(const std::string& link, std::uint64_t generation, gid_t group = other_user,
                  mode_t mode = 0600) {
    if (geteuid() != 0) return false;
    const std::string path = segment_path(link, generation);
    const FileDescriptor file(open(path.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600));
    REQUIRE(file);
    REQUIRE(fchown(file.get(), other_user, group) == 0);
    REQUIRE(fchmod(file.get(), mode) == 0);
    return true;
}

bool exists(const std::string& link, std::uint64_t generation) {
    return std::filesystem::exists(segment_path(link, generation));
}

} // namespace

TEST_CASE("a file of another user raises no generation, and is neither changed nor removed") {
    const Link link;
    if (!foreign_file(link.name, 999)) TANDEM_SKIP(only_root);
    auto first = join(link, Side::first);
    CHECK(first->generation() == 1);
    CHECK(first->ignored_file() == segment_path(link.name, 999));
    auto second = join(link, Side::second);
    CHECK(second->generation() == 1);
    CHECK(first->peer_state() == PeerState::alive);
    CHECK_FALSE(first->superseded());
    // The state after the death of one side.
    first.reset();
    first = join(link, Side::first);
    CHECK(first->generation() == 2);
    CHECK(second->superseded());
    second.reset();
    second = join(link, Side::second);
    CHECK(second->generation() == 2);
    remove_dead(link.name);
    CHECK(exists(link.name, 999));
    CHECK(std::filesystem::file_size(segment_path(link.name, 999)) == 0);
}

TEST_CASE("if a file of another user has the next name, both sides meet in a later generation") {
    const Link link;
    for (const std::uint64_t generation : {1, 2, 3})
        if (!foreign_file(link.name, generation)) TANDEM_SKIP(only_root);
    const auto first = join(link, Side::first), second = join(link, Side::second);
    CHECK(first->generation() > 3);
    CHECK(second->generation() == first->generation());
    CHECK(first->peer_state() == PeerState::alive);
    CHECK(observe(link.name)->segment.generation == first->generation());
}

TEST_CASE("the largest generation in the name of a file of another user splits no link") {
    const Link link;
    if (!foreign_file(link.name, max_generation)) TANDEM_SKIP(only_root);
    const auto first = join(link, Side::first), second = join(link, Side::second);
    CHECK(first->generation() == second->generation());
    CHECK(observe(link.name)->segment.readability == Readability::readable);
    CHECK(observe(link.name, max_generation)->segment.readability == Readability::foreign);
}

TEST_CASE("a name with too many digits is not a generation") {
    const Link link;
    for (const char* generation : {"1000000000000000000", "18446744073709551616", "01", "0", "1x", ""})
        std::ofstream("/dev/shm/" + file_prefix(link.name) + generation) << "x";
    CHECK(list_generations(link.name).empty());
    CHECK(join(link, Side::first)->generation() == 1);
}

TEST_CASE("a generation beyond the last one is refused in one line") {
    const std::string link = Link().name;
    CHECK(next_generation(link, max_generation - 1, access_of_this_process("")) == max_generation);
    CHECK_THROWS_WITH(next_generation(link, max_generation, access_of_this_process("")),
                      Contains(segment_path(link, max_generation)) && Contains("last generation"));
}

TEST_CASE("a symbolic link or a folder of another user under the name of a segment is ignored") {
    if (geteuid() != 0) TANDEM_SKIP(only_root);
    const Link link;
    const std::string symbolic = segment_path(link.name, 1), folder = segment_path(link.name, 2);
    std::filesystem::create_symlink("/etc/passwd", symbolic);
    std::filesystem::create_directory(folder);
    REQUIRE(lchown(symbolic.c_str(), other_user, other_user) == 0);
    REQUIRE(lchown(folder.c_str(), other_user, other_user) == 0);
    CHECK(observe(link.name)->segment.readability == Readability::foreign);
    const auto first = join(link, Side::first), second = join(link, Side::second);
    CHECK(first->generation() == second->generation());
    CHECK(std::filesystem::is_symlink(symbolic));
    CHECK(std::filesystem::exists(folder));
}

TEST_CASE("a file of another user counts if it has the group of the link") {
    const auto* daemon = getgrnam("daemon");
    if (geteuid() != 0 || daemon == nullptr) TANDEM_SKIP("only root may name the group daemon");
    const Link link;
    JoinOptions options = small();
    options.group = "daemon";
    REQUIRE(foreign_file(link.name, 7, daemon->gr_gid, 0660));
    const Access with_group = access_of_this_process("daemon"), without = access_of_this_process("");
    CHECK_FALSE(probe_segment(segment_path(link.name, 7), with_group).foreign);
    CHECK(probe_segment(segment_path(link.name, 7), without).foreign);
    CHECK(open_segment(segment_path(link.name, 7), with_group));
    CHECK_FALSE(open_segment(segment_path(link.name, 7), without));
    CHECK_THROWS_WITH(join(link, Side::first, options), Contains("is not a Tandem segment"));
    CHECK(join(link, Side::first)->generation() == 1);
}

TEST_CASE("a list of segments contains all of this user, and a bounded number of other users' files") {
    const Link link;
    std::size_t before = 0;
    observe_segments(&before);
    if (!foreign_file(link.name, 1000)) TANDEM_SKIP(only_root);
    for (std::uint64_t generation = 1001; generation < 1000 + 2 * max_foreign; ++generation)
        foreign_file(link.name, generation);
    const auto first = join(link, Side::first);
    std::size_t left_out = 0, foreign = 0, own = 0;
    for (const auto& segment : observe_segments(&left_out)) {
        foreign += segment.readability == Readability::foreign ? 1 : 0;
        own += segment.path == first->path() ? 1 : 0;
    }
    CHECK(own == 1);
    CHECK(foreign == max_foreign);
    CHECK(left_out >= before + max_foreign);
}

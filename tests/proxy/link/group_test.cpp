// SPDX-License-Identifier: Apache-2.0
// Who may join a link whose segment is shared with a group of users, and the segment's mode in /dev/shm.
#include "link_side.hpp"
#include "tests/support/skip.hpp"

#include <grp.h>
#include <sys/stat.h>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;

namespace {

std::unique_ptr<LinkSide> side_with_group(shm::Side side, const std::string& name, const std::string& group) {
    LinkOptions options{name};
    options.group = group;
    return std::make_unique<LinkSide>(side, options,
                                      side == shm::Side::first ? PortTable{} : joystick_table());
}

} // namespace

TEST_CASE("a link with a group has a segment of mode 0660 that only a side with a group joins") {
    const auto* own_group = getgrgid(getegid());
    if (own_group == nullptr) TANDEM_SKIP("this process's group has no name");
    const std::string group = own_group->gr_name, name = unique_name("group");
    const auto first = side_with_group(shm::Side::first, name, group);
    first->link.open();
    struct stat file {};
    REQUIRE(stat(shm::segment_path(name, 1).c_str(), &file) == 0);
    CHECK((file.st_mode & 07777) == 0660);
    CHECK(file.st_gid == getegid());
    CHECK_THROWS_WITH(interceptor(name)->link.open(),
                      Catch::Contains("mode 0660, expected owner") && Catch::Contains("mode 0600"));
    const auto second = side_with_group(shm::Side::second, name, group);
    second->link.open();
    first->link.wait_until_up(soon, "peer");
}

TEST_CASE("a side with a group refuses the segment of a side without one, and an unknown group") {
    const auto* own_group = getgrgid(getegid());
    if (own_group == nullptr) TANDEM_SKIP("this process's group has no name");
    const std::string group = own_group->gr_name, name = unique_name("no-group");
    const auto first = adaptor(name);
    first->link.open();
    CHECK_THROWS_WITH(side_with_group(shm::Side::second, name, group)->link.open(),
                      Catch::Contains("mode 0600, expected owner") && Catch::Contains("mode 0660"));
    CHECK_THROWS_WITH(side_with_group(shm::Side::second, name, "no-such-group-here")->link.open(),
                      "group 'no-such-group-here': unknown to this system; create it or name another");
}

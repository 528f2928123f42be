// SPDX-License-Identifier: Apache-2.0
// What another process sees of the parts of this one, by its open files.
#include "tests/host/process/inventory_lines.hpp"

#include <vector>

using namespace tandem::process;
using tandem::test::read_inventory;

namespace {

using Lines = std::multiset<std::string>;

} // namespace

TEST_CASE("the parts of a process are listed where another process reads them, as they are now") {
    const int arm = 0, leg = 0;
    list_part(&arm, {"component", "Arm", "ArmType"});
    list_part(&leg, {"component", "Leg", ""});
    CHECK(std::string(read_inventory().head.magic, 8) == std::string(InventoryHead::magic_text, 8));
    CHECK(read_inventory().lines == Lines{"component\tArm\tArmType", "component\tLeg\t"});
    list_part(&arm, {"component", "Arm", "A"});
    CHECK(read_inventory().lines == Lines{"component\tArm\tA", "component\tLeg\t"});
    list_part(&arm, {"component", "Arm", "a type with a long name"});
    CHECK(read_inventory().lines == Lines{"component\tArm\ta type with a long name", "component\tLeg\t"});
    unlist_part(&arm);
    CHECK(read_inventory().lines == Lines{"component\tLeg\t"});
    unlist_part(&leg);
    unlist_part(&leg);
    CHECK(read_inventory().lines.empty());
}

TEST_CASE("a field of a listed part cannot end its field or line") {
    const int arm = 0;
    list_part(&arm, {"component", "Arm\n\t\x01", "x"});
    CHECK(read_inventory().lines == Lines{"component\tArm???\tx"});
    unlist_part(&arm);
}

TEST_CASE("the number of an inventory is even at rest, and changes only with the list") {
    const int arm = 0;
    list_part(&arm, {"component", "Arm"});
    const auto before = read_inventory().head.sequence;
    CHECK(before % 2 == 0);
    list_part(&arm, {"component", "Arm"});
    CHECK(read_inventory().head.sequence == before);
    list_part(&arm, {"component", "Leg"});
    CHECK(read_inventory().head.sequence == before + 2);
    unlist_part(&arm);
    CHECK(read_inventory().head.sequence == before + 4);
}

TEST_CASE("a list that becomes shorter writes nothing beyond its end") {
    const int arm = 0, old = 0, leg = 0;
    list_part(&arm, {"component", "Arm"});
    list_part(&old, {"component", std::string(100, 'o')});
    list_part(&leg, {"component", std::string(1000, 'l')});
    unlist_part(&old);
    list_part(&leg, {"component", std::string(1001, 'l')}); // closes the gaps
    const auto read = read_inventory();
    CHECK(read.lines == Lines{"component\tArm", "component\t" + std::string(1001, 'l')});
    // The end of the longer list, as it was.
    CHECK(read.rest.find_first_not_of(std::string("l\n\0", 3)) == std::string::npos);
    unlist_part(&leg);
    unlist_part(&arm);
}

TEST_CASE("an inventory stays small while its parts change, and counts parts without room") {
    const int arm = 0;
    for (std::size_t length = 1; length < 3000; ++length)
        list_part(&arm, {"component", std::string(length, 'a')});
    CHECK(read_inventory().head.text_bytes < 10'000);
    std::vector<int> parts(300);
    for (const int& part : parts) list_part(&part, {"component", std::string(4000, 'b')});
    const auto full = read_inventory();
    CHECK(full.head.left_out == parts.size() + 1 - full.lines.size());
    CHECK(full.head.left_out > 30);
    for (const int& part : parts) unlist_part(&part);
    CHECK(read_inventory().head.left_out == 0);
    list_part(&parts[0], {"component", "c"});
    CHECK(read_inventory().lines.count("component\tc") == 1);
    unlist_part(&parts[0]);
    unlist_part(&arm);
}

// SPDX-License-Identifier: Apache-2.0
// What the monitor reads of the components, ports and connections inside hosts, and of hosts without a link.
#include "apps/tandem/monitor/host_files/host_reader.hpp"
#include "apps/tandem/monitor/verdict.hpp"
#include "host/process/file_descriptor.hpp"
#include "host/process/published/inventory.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

using namespace tandem::monitor;
using tandem::process::InventoryHead;
using tandem::process::list_part;
using tandem::process::unlist_part;

namespace {

const auto own_pid = static_cast<std::uint32_t>(getpid());

std::shared_ptr<const HostInventory> read_own_inventory() {
    InventoryReader reader;
    REQUIRE(reader.look(own_pid));
    return reader.read(own_pid);
}

/// Reads the hosts twice, as shares of the processor need.
State hosts_of(bool without_links, const std::vector<LinkState>& links) {
    HostReader reader(without_links);
    State state;
    for (const std::uint64_t now_ns : {1'000'000'000ULL, 3'000'000'000ULL}) {
        state = {};
        state.links = links;
        reader.read(state, now_ns);
    }
    return state;
}

const HostState* own_host(const State& state) {
    for (const HostState& host : state.hosts)
        if (host.pid == own_pid) return &host;
    return nullptr;
}

/// A file of the name of an inventory, with this head and text.
tandem::process::FileDescriptor false_inventory(InventoryHead head, const std::string& text) {
    tandem::process::FileDescriptor file(memfd_create(InventoryHead::file_name, MFD_CLOEXEC));
    REQUIRE(ftruncate(file.get(), InventoryHead::file_bytes) == 0);
    REQUIRE(pwrite(file.get(), &head, sizeof head, 0) == sizeof head);
    REQUIRE(pwrite(file.get(), text.data(), text.size(), sizeof head) == static_cast<ssize_t>(text.size()));
    return file;
}

InventoryHead sound_head(std::uint64_t sequence, std::uint64_t text_bytes) {
    InventoryHead head{};
    std::memcpy(head.magic, InventoryHead::magic_text, sizeof head.magic);
    head.sequence = sequence;
    head.text_bytes = text_bytes;
    return head;
}

} // namespace

TEST_CASE("the components, contexts, ports and connections that a host lists are read") {
    const int arm = 0, context = 0, out = 0, in = 0, connection = 0;
    list_part(&arm, {"component", "Arm", "ArmType", "periodic", "10000000", "arm.rtc", "robot/arm.rtc"});
    list_part(&context, {"context", "Arm", "periodic", "5000000", "1", "Arm", "Leg"});
    list_part(&out, {"port", "Stick", "position", "data", "output", "double"});
    list_part(&in, {"port", "Arm", "position", "data", "input", "double", "id-1"});
    list_part(&connection, {"connection", "Stick", "position", "Arm", "position"});
    const auto inventory = read_own_inventory();
    REQUIRE(inventory->components.size() == 1);
    CHECK(inventory->components[0].execution == "periodic");
    CHECK(inventory->components[0].period_ns == 10'000'000);
    CHECK(inventory->components[0].names == std::vector<std::string>{"arm.rtc", "robot/arm.rtc"});
    REQUIRE(inventory->contexts.size() == 1);
    CHECK(inventory->contexts[0].running);
    CHECK(inventory->contexts[0].components == std::vector<std::string>{"Arm", "Leg"});
    REQUIRE(inventory->ports.size() == 2);
    CHECK(inventory->ports[0].component == "Arm");
    CHECK(inventory->ports[0].connections ==
          std::vector<std::string>{"id-1", "Stick.position -> Arm.position"});
    CHECK(inventory->ports[1].connections == std::vector<std::string>{"Stick.position -> Arm.position"});
    CHECK(inventory->left_out == 0);
    for (const int* part : {&arm, &context, &out, &in, &connection}) unlist_part(part);
    CHECK(read_own_inventory()->components.empty());
}

TEST_CASE("invalid lines of an inventory are counted, and names are made printable") {
    HostInventory inventory;
    parse_inventory(
        "component\tA\x1b[2J\tT\t\t0\n  \n\ncomponent\tshort\nwheel\tA\nport\tA\tp\tdata\toutput\n"
        "context\tA\tperiodic\t99999999999999999999999\t7\n",
        inventory);
    REQUIRE(inventory.components.size() == 1);
    CHECK(inventory.components[0].name.find('\x1b') == std::string::npos);
    REQUIRE(inventory.contexts.size() == 1);
    CHECK_FALSE(inventory.contexts[0].running);
    CHECK(inventory.left_out == 3);
}

TEST_CASE("an inventory that changes, or whose head is wrong, is not read") {
    const std::string text = "component\tArm\tT\t\t0\n";
    for (const auto& head : {sound_head(3, text.size()), sound_head(4, InventoryHead::max_text_bytes + 1),
                             sound_head(4, UINT64_MAX), InventoryHead{}}) {
        const auto file = false_inventory(head, text);
        CHECK(read_own_inventory()->components.empty());
    }
    const auto file = false_inventory(sound_head(4, text.size()), text);
    InventoryReader reader;
    REQUIRE(reader.look(own_pid));
    REQUIRE(reader.read(own_pid)->components.size() == 1);
    const auto head = sound_head(5, 0); // a change has begun
    REQUIRE(pwrite(file.get(), &head, sizeof head, 0) == sizeof head);
    CHECK(reader.read(own_pid)->components.size() == 1);
}

TEST_CASE("an inventory that takes the place of another one is read") {
    const std::string first = "component\tFirst\tT\t\t0\n", second = "component\tSecond\tT\t\t0\n";
    InventoryReader reader;
    {
        const auto file = false_inventory(sound_head(4, first.size()), first);
        REQUIRE(reader.look(own_pid));
        CHECK(reader.read(own_pid)->components.at(0).name == "First");
    }
    const auto file = false_inventory(sound_head(4, second.size()), second);
    REQUIRE(reader.look(own_pid));
    CHECK(reader.read(own_pid)->components.at(0).name == "Second");
}

TEST_CASE("a process without an inventory does not have that of the process before with its pid") {
    InventoryReader reader;
    {
        const std::string text = "component\tBefore\tT\t\t0\n";
        const auto file = false_inventory(sound_head(4, text.size()), text);
        REQUIRE(reader.look(own_pid));
        REQUIRE(reader.read(own_pid)->components.size() == 1);
    }
    const bool has_another = reader.look(own_pid); // of a test before
    const auto inventory = reader.read(own_pid);
    CHECK((has_another ? inventory->components.empty() : inventory == nullptr));
}

TEST_CASE("a host without a link is found by what it lists, and its use of the machine is read") {
    const int arm = 0;
    list_part(&arm, {"component", "Arm", "T", "", "0"});
    const State state = hosts_of(true, {});
    const HostState* const host = own_host(state);
    REQUIRE(host != nullptr);
    CHECK(host->program == "test_tandem_mon"); // the kernel keeps 15 characters
    CHECK(host->links.empty());
    CHECK(host->inventory->components.at(0).name == "Arm");
    CHECK(host->usage.resident_bytes > 100'000);
    CHECK(host->usage.thread_count >= 1);
    CHECK_FALSE(host->usage.threads.empty());
    CHECK(own_host(hosts_of(false, {})) == nullptr);
    unlist_part(&arm);
}

TEST_CASE("a process that only reads the inventory of a host is not listed as a host") {
    const std::string text = "component\tArm\tT\t\t0\n";
    auto file = false_inventory(sound_head(4, text.size()), text);
    InventoryReader reader;
    REQUIRE(reader.look(own_pid));
    CHECK(reader.read(own_pid)->components.size() == 1);
    const tandem::process::FileDescriptor read_only(
        open(("/proc/self/fd/" + std::to_string(file.get())).c_str(), O_RDONLY | O_CLOEXEC));
    REQUIRE(read_only);
    close(file.release());
    reader.keep({});
    CHECK((!reader.look(own_pid) || reader.read(own_pid)->components.empty()));
}

TEST_CASE("the hosts of links are read, with all links of each") {
    std::vector<LinkState> links(2);
    links[0].name = "arm";
    links[1].name = "leg";
    for (LinkState& link : links) link.sides[0] = {tandem::shm::PeerState::alive, own_pid, "test"};
    links[0].sides[1] = {tandem::shm::PeerState::dead, 1, "dead"};
    const State state = hosts_of(false, links);
    REQUIRE(state.hosts.size() == 1);
    CHECK(state.hosts[0].links == std::vector<std::string>{"arm", "leg"});
    CHECK(state.hosts[0].program == "test");
}

TEST_CASE("hosts without a link are judged, too") {
    State state;
    CHECK(judge(state).level == Level::no_link);
    state.hosts = {{44, "rtm_host"}};
    CHECK(judge(state).level == Level::well);
    CHECK(judge(state).reason == "1 host without a link: nothing late in the last 5 s");
    state.hosts[0].usage.stopped = true;
    CHECK(judge(state).level == Level::stopped);
    CHECK(judge(state).reason == "rtm_host (pid 44) is stopped by a signal or a debugger");
}

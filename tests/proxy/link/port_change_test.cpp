// SPDX-License-Identifier: Apache-2.0
// A side whose ports change while the link is up.
#include "link_side.hpp"
#include "proxy/link/protocol/published_table.hpp"
#include "proxy/link/protocol/request.hpp"
#include "proxy/link/registry.hpp"
#include "shm/segment/layout.hpp"
#include "tests/support/captured_log.hpp"

#include <thread>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;
using tandem::test::CapturedLog;

namespace {

struct ChangingSide : LinkSide {
    using LinkSide::LinkSide;
    ~ChangingSide() override { link.close(); }
    void peer_ports_changed() override { ++changes; }
    std::atomic<int> changes{0};
};

Port data_port(const std::string& name, PortKind kind = PortKind::data_out) {
    return {kind, name, "T", "d", "", {}};
}

} // namespace

TEST_CASE("adding and removing ports while the link is up loses no message of the others") {
    const auto name = unique_name("change");
    ChangingSide a(shm::Side::first, LinkOptions{name}, PortTable{});
    auto b = interceptor(name);
    a.link.open();
    b->link.open();
    wait_until_up(a, *b);
    constexpr int messages = 20'000;
    std::thread sender([&] {
        for (int i = 0; i < messages; ++i) send(b->link.writer("reference"), i);
    });
    int received = 0, changes = 0;
    const auto take = [&] {
        while (receive(a.link.reader("reference"))) ++received;
    };
    PortTable table = joystick_table();
    for (int i = 0; i < 4; ++i) {
        const std::string port = fmt::format("late{}", i);
        table.ports.push_back(data_port(port));
        b->link.set_ports(table);
        ++changes;
        REQUIRE(eventually([&] {
            take();
            return a.changes == changes;
        }));
        CHECK(a.table == table);
        REQUIRE(send(b->link.writer(port), i));
        CHECK(receive(a.link.reader(port)) == i);
    }
    table.ports.erase(table.ports.begin() + 2);
    b->link.set_ports(table);
    REQUIRE(eventually([&] {
        take();
        return a.changes == changes + 1;
    }));
    CHECK(a.table == table);
    sender.join();
    take();
    const auto counters = a.link.reader("reference").counters();
    CHECK(counters.sent == messages);
    CHECK(counters.received == static_cast<std::uint64_t>(received));
    CHECK(counters.sent == counters.received + counters.dropped());
    CHECK(a.downs == 0);
    CHECK(b->downs == 0);
}

TEST_CASE("a peer that comes later gets ports that were added before, including in the next session") {
    const auto name = unique_name("before");
    auto b = interceptor(name);
    b->link.open();
    PortTable table = joystick_table();
    table.ports.push_back(data_port("late", PortKind::data_in));
    b->link.set_ports(table);
    for (int round = 0; round < 2; ++round) {
        auto a = adaptor(name);
        a->link.open();
        wait_until_up(*a, *b);
        REQUIRE(eventually([&] { return a->link.writer("late").is_bound(); }));
        REQUIRE(send(a->link.writer("late"), 3));
        CHECK(receive(b->link.reader("late")) == 3);
        a.reset();
        REQUIRE(eventually([&] { return b->downs == round + 1; }));
    }
}

TEST_CASE("a port that gets another type gets other channels, and nothing passes from the old ones") {
    const auto name = unique_name("type");
    ChangingSide a(shm::Side::first, LinkOptions{name}, PortTable{});
    auto b = interceptor(name);
    a.link.open();
    b->link.open();
    wait_until_up(a, *b);
    Port before = data_port("late"), after = before;
    after.signature = "i";
    int changes = 0;
    const auto publish = [&](const Port& port) {
        PortTable table = joystick_table();
        table.ports.push_back(port);
        b->link.set_ports(table);
        ++changes;
        REQUIRE(eventually([&] { return a.changes == changes; }));
        CHECK(a.table.find("late")->is_same(port));
    };
    publish(before);
    REQUIRE(send(b->link.writer(before), 1));
    publish(after);
    CHECK(a.table.find("late")->ring == 1);
    REQUIRE(send(b->link.writer(before), 2)); // a thread that has not noticed
    REQUIRE(send(b->link.writer(after), 3));
    CHECK(receive(a.link.reader(after)) == 3);
    CHECK_FALSE(receive(a.link.reader(after)));
    publish(before);
    CHECK(a.table.find("late")->ring == 0);
    CHECK(a.link.reader(before).discard() == 2);
    REQUIRE(send(b->link.writer(before), 4));
    CHECK(receive(a.link.reader(before)) == 4);
    Port turned = before; // the other way round
    turned.kind = PortKind::data_in;
    publish(turned);
    REQUIRE(send(a.link.writer(turned), 5));
    CHECK(receive(b->link.reader(turned)) == 5);
}

TEST_CASE("a peer that returns gets the port's current type, and no message of the last session") {
    const auto name = unique_name("again");
    auto a = adaptor(name);
    a->link.open();
    Port port = data_port("value");
    for (const char* signature : {"d", "i", "d"}) {
        port.signature = signature;
        LinkSide b(shm::Side::second, LinkOptions{name}, {{{"Rtc0"}}, {port}});
        b.link.open();
        wait_until_up(*a, b);
        REQUIRE(eventually([&] { return a->link.reader(port).is_bound(); }));
        REQUIRE(send(b.link.writer(port), 1));
        CHECK(receive(a->link.reader(port)) == 1);
        REQUIRE(send(b.link.writer(port), 2)); // lost with the session
        const int downs = a->downs;
        b.link.close();
        REQUIRE(eventually([&] { return a->downs == downs + 1; }));
    }
}

TEST_CASE("a side that asks for the doorbell before its peer knows the port is rung once the port exists") {
    const auto name = unique_name("bell");
    ChangingSide a(shm::Side::first, LinkOptions{name}, PortTable{});
    auto b = interceptor(name);
    const Port late = data_port("late", PortKind::data_in);
    std::atomic<int> arrivals{0};
    a.on_call = [&](const Request& request) {
        a.link.serve_listen(request.arguments);
        return Reply{};
    };
    a.link.open();
    b->link.open();
    wait_until_up(a, *b);
    b->link.set_arrival_listener(b->link.reader(late), [&] { ++arrivals; });
    REQUIRE(b->link.request_rings({"late"}, soon).status == CallStatus::ok);
    PortTable table = joystick_table();
    table.ports.push_back(late);
    b->link.set_ports(table);
    REQUIRE(eventually([&] { return a.changes == 1; }));
    REQUIRE(send(a.link.writer(late), 1));
    CHECK(eventually([&] { return arrivals == 1; }));
}

TEST_CASE("a port without room in the segment is left out, and the others stay") {
    const auto name = unique_name("room");
    ChangingSide a(shm::Side::first, LinkOptions{name}, PortTable{});
    auto b = interceptor(name);
    a.link.open();
    b->link.open();
    wait_until_up(a, *b);
    PortTable table = joystick_table();
    constexpr int ports = 40; // with 32 MiB each, of which there is room for some ten
    for (int i = 0; i < ports; ++i) {
        table.ports.push_back(data_port(fmt::format("late{}", i)));
        table.ports.back().signature = "ad";
    }
    b->link.set_ports(table);
    REQUIRE(eventually([&] { return a.changes == 1; }));
    CHECK(a.table.ports.size() >= 2 + 8);
    CHECK(a.table.ports.size() < 2 + ports);
    REQUIRE(send(b->link.writer("late0"), 4));
    CHECK(receive(a.link.reader("late0")) == 4);
    REQUIRE(send(b->link.writer("reference"), 5));
    CHECK(receive(a.link.reader("reference")) == 5);
}

TEST_CASE("a registry finds the objects added last, by name and by number") {
    Registry<int> registry;
    int arm = 1, leg = 2, other_arm = 3;
    registry.add("arm", arm, port_id("arm"));
    registry.add("leg", leg, port_id("leg"));
    CHECK(registry.find("arm") == &arm);
    CHECK(registry.find(port_id("leg")) == &leg);
    CHECK(registry.find("tail") == nullptr);
    CHECK(registry.find(port_id("tail")) == nullptr);
    registry.add("arm", other_arm, port_id("arm"));
    CHECK(registry.find("arm") == &other_arm);
    CHECK(registry.find(port_id("arm")) == &other_arm);
    CHECK(registry.all() == std::vector<int*>{&other_arm, &leg});
}

TEST_CASE("messages left in the ring of a removed port can be discarded and are counted") {
    const auto name = unique_name("discard");
    auto a = adaptor(name), b = interceptor(name);
    a->link.open();
    b->link.open();
    wait_until_up(*a, *b);
    for (int i = 0; i < 5; ++i) REQUIRE(send(b->link.writer("reference"), i));
    CHECK(a->link.reader("reference").discard() == 5);
    CHECK(a->link.reader("reference").discard() == 0);
    CHECK_FALSE(receive(a->link.reader("reference")));
}

TEST_CASE("a published table is read back unchanged, and not while it is being changed or if it is damaged") {
    const auto encoded = encode(joystick_table());
    std::vector<std::byte> blob(published_table_bytes(encoded.size(), false));
    REQUIRE(write_published_table(blob, encoded, 3));
    const auto back = read_published_table(blob);
    REQUIRE(back);
    CHECK(back->version == 3);
    CHECK(back->table == joystick_table());
    CHECK(published_version(blob) == 3);

    auto changing = blob;
    changing.back() = std::byte{1};
    CHECK_FALSE(read_published_table(changing));
    auto damaged = blob;
    damaged[12] = std::byte{255}; // the length
    CHECK_THROWS_AS(read_published_table(damaged), LinkError);
    CHECK_THROWS_AS(read_published_table(std::span(blob).first(16)), LinkError);
    PortTable longer = joystick_table();
    longer.ports.push_back(data_port(std::string(1000, 'x')));
    CHECK_FALSE(write_published_table(blob, encode(longer), 4));
    CHECK(read_published_table(blob)->version == 3);
}

TEST_CASE("late ports without room get one line with a remedy, and the next peer gets them all") {
    const auto name = unique_name("crowd");
    const CapturedLog log;
    auto a = std::make_unique<ChangingSide>(shm::Side::first, LinkOptions{name}, PortTable{});
    auto b = interceptor(name);
    a->link.open();
    b->link.open();
    wait_until_up(*a, *b);
    PortTable table = joystick_table();
    for (int i = 0; i < 58; ++i) {
        Port port = data_port(fmt::format("late{}", i));
        port.signature = "s";
        table.ports.push_back(port);
        const int changes = a->changes;
        b->link.set_ports(table);
        REQUIRE(eventually([&] { return a->changes > changes; }));
    }
    const std::size_t shared = a->table.ports.size();
    CHECK(shared < table.ports.size());
    CHECK(log.lines_with("was added after the link was set up and is not shared") == 1);
    CHECK(
        log.lines_with("add 33 to this side's `segment_mib` (now 4) for each such port, or restart the other "
                       "host") == 1);
    CHECK(log.lines_with(fmt::format("port 'late{}'", shared - 2)) == 1);
    CHECK(log.lines_with("late") == 1);
    a.reset();
    REQUIRE(eventually([&] { return b->downs == 1; }));
    a = std::make_unique<ChangingSide>(shm::Side::first, LinkOptions{name}, PortTable{});
    a->link.open();
    wait_until_up(*a, *b);
    CHECK(a->table.ports.size() == table.ports.size());
}

TEST_CASE("the remedy for late ports without room is enough") {
    const auto name = unique_name("remedy");
    const CapturedLog log;
    LinkOptions options{name};
    options.segment_bytes = std::size_t{1024} * 1024 * (4 + 20 * 33);
    ChangingSide a(shm::Side::first, LinkOptions{name}, PortTable{});
    LinkSide b(shm::Side::second, options, joystick_table());
    a.link.open();
    b.link.open();
    wait_until_up(a, b);
    PortTable table = joystick_table();
    for (int i = 0; i < 20; ++i) {
        table.ports.push_back(data_port(fmt::format("late{}", i)));
        table.ports.back().signature = "s";
    }
    b.link.set_ports(table);
    CHECK(eventually([&] { return a.changes == 1; }));
    CHECK(a.table.ports.size() == table.ports.size());
    CHECK(log.lines_with("late") == 0);
}

TEST_CASE("late ports beyond what a side can have do not keep the link from coming back") {
    const auto name = unique_name("beyond");
    const CapturedLog log;
    LinkOptions options{name};
    options.segment_bytes = std::size_t{256} * 1024 * 1024;
    auto a = std::make_unique<ChangingSide>(shm::Side::first, LinkOptions{name}, PortTable{});
    LinkSide b(shm::Side::second, options, joystick_table());
    a->link.open();
    b.link.open();
    wait_until_up(*a, b);
    PortTable table = joystick_table();
    for (std::size_t i = 0; i < shm::layout::max_objects; ++i)
        table.ports.push_back(data_port(fmt::format("late{}", i)));
    b.link.set_ports(table);
    REQUIRE(eventually([&] { return log.lines_with("further ports that are not shared") == 1; }));
    a.reset();
    REQUIRE(eventually([&] { return b.downs == 1; }));
    a = std::make_unique<ChangingSide>(shm::Side::first, LinkOptions{name}, PortTable{});
    a->link.open();
    wait_until_up(*a, b);
    CHECK(a->table.ports.size() > table.ports.size() / 2);
    CHECK(a->table.ports.size() < table.ports.size());
}

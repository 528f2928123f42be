// SPDX-License-Identifier: Apache-2.0
// What a process lists of its RTCs for other processes.
#include "tests/host/process/inventory_lines.hpp"
#include "tests/host/rtm/manager_fixture.hpp"

using namespace testing;
using tandem::test::count_parts;
using tandem::test::read_inventory;

namespace {

/// Returns the connections of a listed port; nothing if it is not listed.
std::optional<std::vector<std::string>> connections_of(const std::string& component,
                                                       const std::string& port) {
    for (const auto& line : read_inventory().lines) {
        if (!line.starts_with("port\t" + component + "\t" + port + "\t")) continue;
        const auto fields = coil::split(line, "\t");
        return std::vector<std::string>(fields.begin() + std::min<std::ptrdiff_t>(6, std::ssize(fields)),
                                        fields.end());
    }
    return {};
}

} // namespace

TEST_CASE("components, their contexts and their ports are listed while they exist") {
    ManagerFixture fixture(false);
    auto& counter = fixture.create<Counter>("Counter?exec_cxt.periodic.rate=50");
    CHECK(count_parts("component\tCounter0\tCounter\t") == 1);
    CHECK(count_parts("context\tCounter0\tperiodic\t20000000\t1\tCounter0") == 1);
    CHECK(count_parts("port\tCounter0\tout\tdata\toutput\tIDL:RTC/TimedLong:1.0") == 1);
    counter.setExecutionRate(0, 100);
    CHECK(count_parts("context\tCounter0\tperiodic\t10000000\t1\tCounter0") == 1);
    CHECK(count_parts("context\tCounter0") == 1);
    counter.exit();
    RTC::Manager::instance().cleanupComponents();
    CHECK(count_parts("component\tCounter0") == 0);
    CHECK(count_parts("context\tCounter0") == 0);
    CHECK(count_parts("port\tCounter0") == 0);
}

TEST_CASE("the two ports of a connection list the same id until it ends") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    CHECK(connections_of("Counter0", "out")->empty());
    fixture.connect("Counter0.out?port=Accumulator0.in");
    REQUIRE(connections_of("Counter0", "out")->size() == 1);
    CHECK(connections_of("Counter0", "out") == connections_of("Accumulator0", "in"));
    counter.out_.disconnect_all();
    CHECK(connections_of("Counter0", "out")->empty());
    CHECK(connections_of("Accumulator0", "in")->empty());
}

TEST_CASE("a port that its component removes is no longer listed") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    counter.removeOutPort(counter.out_);
    CHECK_FALSE(connections_of("Counter0", "out"));
    counter.addOutPort("out", counter.out_);
    CHECK(connections_of("Counter0", "out"));
}

TEST_CASE("the context of a composite lists the members that it runs") {
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:100"});
    fixture.create<Counter>("Counter");
    fixture.manager().createOrThrow("PeriodicECSharedComposite?instance_name=Both&members=Counter0");
    CHECK(count_parts("context\tBoth\tperiodic\t10000000\t1\tBoth\tCounter0") == 1);
}

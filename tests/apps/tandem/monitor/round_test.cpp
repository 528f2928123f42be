// SPDX-License-Identifier: Apache-2.0
// What one round reads if there is more than its limits allow.
#include "apps/tandem/monitor/state_reader.hpp"
#include "running_monitor.hpp"
#include "shm/ring/ring_writer.hpp"

#include <nlohmann/json.hpp>

using namespace tandem::monitor;
using namespace tandem::monitor::test;
using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

std::size_t ports_with_value(const State& state) {
    const auto& ports = state.links.at(0).ports;
    return static_cast<std::size_t>(
        std::count_if(ports.begin(), ports.end(), [](const auto& port) { return !port.value.is_null(); }));
}

void write_number(const RingHandle& ring, double value) {
    RingWriter writer(ring);
    REQUIRE(writer.write(std::as_bytes(std::span(&value, 1)), now_ns()));
}

} // namespace

TEST_CASE(
    "a scan that reaches its limit of messages reports this, and the next scan begins with the other ports") {
    const Pair pair;
    const auto rings = add_ports(*pair.first, {"left", "right"});
    StateReader reader({pair.link.name}, nullptr, {.message_bytes = 1});
    CHECK(reader.read().cut.empty());
    for (const auto& ring : rings) write_number(ring, 1);
    State state = reader.read();
    CHECK(ports_with_value(state) == 1);
    CHECK_THAT(state.cut, Catch::Contains("link " + pair.link.name) && Catch::Contains("not all messages"));
    CHECK(state.cut.find('\n') == std::string::npos);
    state = reader.read(state);
    CHECK(ports_with_value(state) == 2);
}

TEST_CASE("a scan without time reads one link, keeps the others as they were, and the next scan reads "
          "another one") {
    const Pair first, second;
    std::vector<std::string> names{first.link.name, second.link.name};
    std::sort(names.begin(), names.end());
    StateReader reader(names, nullptr, {.time_ns = 0});
    State state = reader.read();
    REQUIRE(state.links.size() == 1);
    CHECK(state.links[0].name == names[0]);
    CHECK_FALSE(state.cut.empty());
    state = reader.read(state);
    REQUIRE(state.links.size() == 2);
    CHECK(state.links[0].name == names[0]);
    CHECK(state.links[1].name == names[1]);
}

TEST_CASE("a stopped scan ends without reading the ports") {
    const Pair pair;
    add_ports(*pair.first, {"left", "right"});
    const std::atomic<bool> stop = true;
    StateReader reader({pair.link.name}, &stop);
    const State state = reader.read();
    REQUIRE(state.links.size() == 1);
    CHECK(state.links[0].ports.empty());
}

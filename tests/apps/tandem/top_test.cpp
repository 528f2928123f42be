// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/top/graph_dot.hpp"
#include "followed_link.hpp"
#include "monitor/states.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace tandem;
using namespace tandem::command;
using namespace tandem::test;

namespace {

const nlohmann::json* find_host(const nlohmann::json& picture, pid_t pid) {
    for (const auto& host : picture["hosts"])
        if (host["pid"] == pid) return &host;
    return nullptr;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("top shows hosts, ports and a verdict, once per period") {
    FollowedLink link({timed_double_port("temperature")});
    link.send("temperature", 1, 2);
    const auto text = tandem_program({"top", link.name(), "--period", "0.1", "--count", "2"});
    CHECK(text.exit_code == 0);
    CHECK(text.errors.empty());
    const auto first = text.output.find("HOST ");
    REQUIRE(first != std::string::npos);
    CHECK(text.output.find("HOST ", first + 1) != std::string::npos);
    CHECK(text.output_contains(link.name() + "  temperature"));
    CHECK_FALSE(text.output_contains("\033"));
    const auto json = tandem_program({"top", link.name(), "--period", "0.1", "--count", "2", "--json"});
    std::istringstream lines(json.output);
    int pictures = 0;
    for (std::string line; std::getline(lines, line); ++pictures) {
        const auto picture = nlohmann::json::parse(line);
        REQUIRE(picture["links"].size() == 1);
        CHECK(picture["links"][0]["ports"][0]["sent"] == 1);
        const auto* const host = find_host(picture, getpid());
        REQUIRE(host != nullptr);
        CHECK((*host)["resident_bytes"] > 100'000);
        CHECK((*host)["threads"] >= 1);
        CHECK((*host)["links"] == nlohmann::json{link.name()});
    }
    CHECK(pictures == 2);
}

TEST_CASE("top refuses a link that does not exist") {
    const FollowedLink link({timed_double_port("temperature")});
    for (const bool json : {false, true}) {
        std::vector<std::string> arguments{"top",     link.name(), "no-such-link", "--period", "0.1",
                                           "--count", "1"};
        if (json) arguments.emplace_back("--json");
        const auto absent = tandem_program(arguments);
        CHECK(absent.exit_code == 1);
        CHECK(absent.output.empty());
        CHECK(absent.errors ==
              "tandem: link 'no-such-link' does not exist; tandem shm list shows existing links\n");
    }
}

TEST_CASE("graph prints the connections as text, for Graphviz and as JSON") {
    const FollowedLink link({timed_double_port("temperature")});
    const auto text = tandem_program({"graph", link.name()});
    CHECK(text.exit_code == 0);
    const auto json = tandem_program({"graph", link.name(), "--json"}).json();
    // Both sides are this process, which is of no model.
    const std::string program = json["links"][0]["sides"]["second"]["program"];
    CHECK(text.output_contains("  Sensor0 -> " + program + "  temperature  0.0/s\n"));
    CHECK(json["links"][0]["name"] == link.name());
    const auto absent = tandem_program({"graph", "no-such-link"});
    CHECK(absent.exit_code == 1);
    CHECK(absent.errors ==
          "tandem: link 'no-such-link' does not exist; tandem shm list shows existing links\n");
    const auto svg = tandem_program({"graph", link.name(), "--svg"});
    if (svg.exit_code == 0)
        CHECK((svg.output_contains("<svg ") && svg.output_contains("temperature 0.0/s")));
    else
        CHECK(svg.errors ==
              "tandem: --svg: the program dot was not found: install the package graphviz, or use --dot\n");
}

TEST_CASE("a drawing marks what is dead, silent, damaged or cannot be connected, and quotes names") {
    auto link = monitor::test::sound_link();
    link.ports[0].component = R"(Arm"0\)";
    link.ports[0].sent_per_s = 100;
    link.ports[0].silent_s = 0.01;
    auto silent = monitor::test::port("silent");
    auto damaged = monitor::test::port("damaged");
    damaged.damage = "the file ends within it";
    link.ports.insert(link.ports.end(), {silent, damaged});
    link.shared_ports = {{"grip", "Hand0", "Grip", shm::Side::second, "provided", ""},
                         {"odd", "Hand0", "?", shm::Side::second, "out", "a type without members"}};
    link.sides[1].state = shm::PeerState::dead;
    auto state = monitor::test::state_of({link});
    state.refused = {{"opros_host", 11, "Stick.position", "Adaptor.velocity", "the types differ"}};
    const std::string dot = graph_dot(state);
    CHECK(has(
        dot,
        R"("11 Stick" -> "11 Adaptor" [label="Stick.position and Adaptor.velocity are not connected" color=red)"));
    CHECK(has(dot, R"("11 link chair" -> "22 Arm\"0\\" [label="velocity 100.0/s"])"));
    CHECK(has(dot, R"([label="silent 0.0/s" color=grey fontcolor=grey40])"));
    CHECK(has(dot, R"([label="damaged: the file ends within it" color=red fontcolor=red])"));
    CHECK(has(dot, R"("11 link chair" -> "22 Hand0" [label="grip" style=dashed])"));
    CHECK(has(
        dot, R"("22 Hand0" -> "11 link chair" [label="odd: a type without members" style=dashed color=red)"));
    CHECK(has(dot, "label=\"rtm_host 22, dead\"\n    color=red"));
}

TEST_CASE("a graph has the components of every host, and the connections that no link carries") {
    monitor::HostInventory inventory;
    inventory.components = {{"Arm0", "Arm", ""}, {"Sensor0", "Sensor", ""}};
    inventory.ports = {{"Arm0", "in", "data", "input", "TimedLong", {"1"}},
                       {"Arm0", "tool", "service", "required", "Tool", {"2"}},
                       {"Sensor0", "out", "data", "output", "TimedLong", {"1", "3"}}};
    monitor::HostInventory other;
    other.components = {{"Hand0", "Hand", ""}};
    other.ports = {{"Hand0", "tool", "service", "provided", "Tool", {"2"}}};
    monitor::State state;
    state.hosts = {{44, "rtm_host", {}, {}, std::make_shared<monitor::HostInventory>(inventory)},
                   {55, "rtm_host", {}, {}, std::make_shared<monitor::HostInventory>(other)}};
    const std::string dot = graph_dot(state);
    CHECK(has(dot, "label=\"rtm_host 44\""));
    CHECK(has(dot, R"("44 Sensor0" [label="Sensor0" shape=box])"));
    CHECK(has(dot, R"("44 Sensor0" -> "44 Arm0" [label="out"])"));
    CHECK(has(dot, R"("44 Arm0" -> "55 Hand0" [label="tool" style=dashed])"));
}

TEST_CASE("a graph shows a bounded number of the connections of ports that share an id") {
    auto inventory = std::make_shared<monitor::HostInventory>();
    for (int i = 0; i < 200; ++i)
        for (const char* direction : {"output", "input"})
            inventory->ports.push_back({"Arm0", direction + std::to_string(i), "data", direction, "", {"1"}});
    monitor::State state;
    state.hosts = {{44, "rtm_host", {}, {}, inventory}};
    const std::string dot = graph_dot(state);
    CHECK(has(dot, "label=\"connections that are not shown: 30000\""));
    CHECK(std::count(dot.begin(), dot.end(), '>') == 10'000);
}

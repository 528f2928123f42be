// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/refusal_reader.hpp"
#include "host/process/published/refused_connections.hpp"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <memory>
#include <vector>

using namespace tandem::monitor;
using tandem::process::OwnRefusedConnection;
using tandem::process::RefusedConnections;

TEST_CASE("refused connections of a process can be read from outside while they last") {
    RefusalReader reader;
    std::uint64_t now_ns = 0;
    const auto read = [&] {
        State state;
        state.links.emplace_back();
        state.links[0].sides[0] = {tandem::shm::PeerState::alive, static_cast<std::uint32_t>(getpid()),
                                   "test"};
        reader.read(state, now_ns += 10'000'000'000);
        return state.refused;
    };
    CHECK(read().empty());
    auto first = std::make_unique<OwnRefusedConnection>("A.out", "B.in", std::string(5000, 'x'));
    const OwnRefusedConnection second("C.out", "D.in", "the types\ndiffer");
    auto refused = read();
    REQUIRE(refused.size() == 2);
    CHECK(refused[0].from == "A.out");
    CHECK(refused[0].to == "B.in");
    CHECK(refused[0].reason == std::string(sizeof(tandem::process::RefusedConnection::reason) - 1, 'x'));
    CHECK(refused[1].program == "test");
    CHECK(refused[1].reason.find('\n') == std::string::npos);
    first.reset();
    refused = read();
    REQUIRE(refused.size() == 1);
    CHECK(refused[0].from == "C.out");
    std::vector<std::unique_ptr<OwnRefusedConnection>> many;
    for (int i = 0; i < 100; ++i)
        many.push_back(std::make_unique<OwnRefusedConnection>("A.out", "B.in", "x"));
    CHECK(read().size() == RefusedConnections::places);
    many.clear();
    CHECK(read().size() == 1);
}

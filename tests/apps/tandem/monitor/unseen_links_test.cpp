// SPDX-License-Identifier: Apache-2.0
// What the verdict says of links that are missing, damaged or not published.
#include "apps/tandem/monitor/state_reader.hpp"
#include "apps/tandem/monitor/verdict.hpp"
#include "running_monitor.hpp"
#include "shm/call/call_client.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstring>

using namespace tandem::monitor;
using namespace tandem::monitor::test;
using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

Verdict verdict_of(const std::vector<std::string>& links) { return judge(StateReader(links).read()); }

} // namespace

TEST_CASE(
    "a link that was requested by name and does not exist is reported as missing, along with healthy ones") {
    const Pair pair;
    pair.first->publish();
    pair.second->publish();
    CHECK(verdict_of({pair.link.name}).level == Level::well);
    const Verdict verdict = verdict_of({pair.link.name, "no-such-link"});
    CHECK(verdict.level == Level::missing);
    CHECK(verdict.reason == "link no-such-link does not exist; start its hosts");
}

TEST_CASE("a host that has joined and has not published its ports is waited for") {
    const Pair pair;
    pair.first->publish();
    const Verdict verdict = verdict_of({pair.link.name});
    CHECK(verdict.level == Level::waiting);
    CHECK_THAT(verdict.reason, Catch::EndsWith("has joined, but has not published its ports"));
}

TEST_CASE("a link whose port table cannot be read is unreadable in the verdict") {
    const Pair pair;
    const auto blob = pair.first->add_blob(tandem::link::table_name, 64);
    std::memset(blob.data(), 1, blob.size());
    pair.first->publish();
    pair.second->publish();
    const Verdict verdict = verdict_of({pair.link.name});
    CHECK(verdict.level == Level::unreadable);
    CHECK_THAT(verdict.reason, Catch::Contains("the port table of the first side cannot be read"));
}

TEST_CASE("a link that one host has joined waits for the other") {
    const Link link;
    const auto first = join(link, Side::first);
    first->publish();
    const Verdict verdict = verdict_of({link.name});
    CHECK(verdict.level == Level::waiting);
    CHECK_THAT(verdict.reason, Catch::EndsWith("host has not joined"));
}

TEST_CASE("a call that times out makes a link late") {
    const Pair pair;
    const auto queue =
        pair.first->add_call_queue("calls", {.callers = Side::second, .slots = 2, .max_bytes = 64});
    pair.first->publish();
    pair.second->publish();
    StateReader reader({pair.link.name});
    const State before = reader.read();
    CHECK(judge(before).level == Level::well);
    CallClient client(*pair.second->find_call_queue(Side::first, "calls"));
    CHECK(client.call({}, std::chrono::milliseconds(1)).status == CallStatus::timeout); // nobody serves
    const Verdict verdict = judge(reader.read(before));
    CHECK(verdict.level == Level::late);
    CHECK_THAT(verdict.reason, Catch::Contains("1 timed out or refused"));
}

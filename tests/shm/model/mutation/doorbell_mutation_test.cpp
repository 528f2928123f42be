// SPDX-License-Identifier: Apache-2.0
// Checks that the model check of the doorbell detects damaged code. Every access of the shipping code is weakened or broken,
// one at a time.
#include "tests/shm/model/mutation/mutation_check.hpp"
#include "tests/shm/model/scenarios/doorbell_scenarios.hpp"

namespace tandem::shm::model::doorbell_mutation {
namespace {

constexpr auto order = Damage::weaker_order, failure = Damage::weaker_failure, no_store = Damage::no_store;
constexpr const char* bell = "basic_doorbell.hpp";
constexpr const char* costs = "costs a needless wake-up or a write to the owner's line only";
constexpr const char* one_wins = "decides who of several ringers makes the call, and nothing else";

const std::vector<Spared> spared{
    {bell, "last_seen_owner_.store(owner", no_store, {}, costs},
    {bell, "words_.owner.compare_exchange_strong(owner, awake", order, {}, one_wins},
    {bell, "words_.owner.compare_exchange_strong(owner, awake", failure, {}, one_wins},
    {bell, "words_.owner.compare_exchange_strong(owner, awake", Damage::no_comparison, {}, costs},
    {bell, "words_.owner.store(static_cast<std::uint32_t>(afterwards)", no_store, {}, costs},
};

TEST_CASE("Each weakened order or removed step of the doorbell is caught or listed with a reason") {
    check_mutations(doorbell_cases(), spared, 300, 2000);
}

// An access may exist in the correct order although its result is unused. Here ready() works only for the first check of a
// wait, so the check between the announcement and the sleep has no effect. With the first port the ringer notices that the
// owner is awake, so it omits the bit for the second port.
TEST_CASE("An owner that does not look again before it sleeps is caught") {
    const auto outcome = explore(
        [](Execution& execution) {
            DoorbellWorld world(execution, 2, {WaitMode::futex});
            execution.thread("owner", [&] { world.look_without_second_look(); });
            execution.thread("ringer", [&] { world.publish(0), world.publish(1); });
            execution.run();
        },
        Effort{});
    CHECK_THAT(outcome.failure, Catch::StartsWith("asleep, and nobody is left to wake"));
}

} // namespace
} // namespace tandem::shm::model::doorbell_mutation

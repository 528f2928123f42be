// SPDX-License-Identifier: Apache-2.0
// Would the model check of the doorbell notice? Every access of the shipping code is weakened or broken, one
// at a time.
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

// An access may be there and in order, and its result unused: here ready() has an answer for the first look
// of a wait only, so the one between "I sleep" and the sleep is as good as removed. The first port teaches the
// ringer that the owner looks, so that it does without the bit for the second.
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

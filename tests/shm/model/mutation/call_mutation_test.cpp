// SPDX-License-Identifier: Apache-2.0
// Checks that the model check of the call queue detects damaged code. Every access of the shipping code is weakened or broken,
// one at a time.
#include "tests/shm/model/mutation/mutation_check.hpp"
#include "tests/shm/model/scenarios/call_scenarios.hpp"

namespace tandem::shm::model::call_mutation {
namespace {

constexpr auto order = Damage::weaker_order, failure = Damage::weaker_failure, no_store = Damage::no_store;
constexpr const char* caller = "call_caller.hpp";
constexpr const char* worker = "call_worker.hpp";
constexpr const char* asleep = "sleep_until.hpp";

constexpr const char* plain =
    "hands over plain data inside of one process, which the model does not see (TSan does)";
constexpr const char* one_wins =
    "of two compare-exchanges from one value one wins, in any order: that alone decides";
constexpr const char* kernel =
    "the kernel's comparison and its barrier in the wake-up say the same once more";
constexpr const char* twice =
    "`waits_ended_` and `wake_count` each tell a worker to look again; one of the two suffices";
constexpr const char* costs = "costs a needless wake-up or a hint only";

const std::vector<Spared> spared{
    {caller,
     "const std::uint64_t word = request.word.load(std::memory_order_acquire)",
     order,
     {},
     "withdraw() and claim() look again with acquire before the slot is used"},
    {caller,
     "owner.store(claimed, std::memory_order_relaxed)",
     no_store,
     {},
     "in the constructor: nobody else is there"},
    {caller,
     "view_.slots[ticket.slot].reply.word.load(std::memory_order_acquire)",
     order,
     {},
     "replied() has read the same word with seq_cst before"},
    {caller, "parked(sequence_of(", order, {}, "what is stored next depends on it"},
    {caller,
     "used.load(std::memory_order_seq_cst)",
     order,
     {},
     "with the two slots of the scenarios, who sees the bit has claimed the slot of the call that has set "
     "it; with four it "
     "may be that of another slot, and then this order counts"},
    {caller, "owner.compare_exchange_strong(seen, claimed", order, {}, plain},
    {caller, "owner.compare_exchange_strong(seen, claimed", failure, {}, plain},
    {caller, "owner.store(state, std::memory_order_release)", order, {}, plain},
    {caller,
     "request.word.store(with_state(ticket.word",
     no_store,
     {},
     "the server is dead, nobody reads it"},
    {caller, "worker_wakes.fetch_add", no_store, {}, "statistics"},
    {caller, "request.submitted_ns.store(", no_store, {}, "only the order in which waiting calls are taken"},
    {caller, "header->wake_count.fetch_add", order, {}, kernel},
    {caller,
     "header->workers_asleep.load(std::memory_order_seq_cst) != 0)",
     order,
     {},
     "begin() has seen those who lay down before the call was there, and a later look sees no older count; "
     "those who lie down after it see the call"},
    {asleep, "word.store(0, std::memory_order_relaxed)", no_store, {}, costs},
    {asleep, "word.exchange(0,", order, {}, "the load before it is the one that must not miss the sleeper"},
    {"call_view.hpp", "A::copy_atomic_to_shared(cells, at", order, {}, one_wins},
    {"call_view.hpp", "A::copy_atomic_from_shared(to, cells", order, {}, one_wins},
    {worker, "busy_[slot].exchange(1,", order, {}, plain},
    {worker, "busy_[slot].store(0,", order, {}, plain},
    {worker, "busy_[taken.slot].store(0,", order, {}, plain},
    {worker,
     "with_state(word, layout::CallState::cancelled)",
     Damage::no_comparison,
     {},
     "the callers are dead"},
    {worker, "const std::uint32_t wake_count = header.wake_count.load(", order, {}, kernel},
    {worker, "header.workers_asleep.fetch_sub", order, {}, costs},
    {worker, "header.workers_asleep.fetch_sub", no_store, {}, costs},
    {worker, "waits_ended_.store(1,", order, {}, twice},
    {worker, "waits_ended_.load(", order, {}, twice},
    {worker, "header->wake_count.fetch_add", order, {}, kernel},
    {worker, "header.wake_count.fetch_add", order, {}, kernel},
    {worker,
     "has_poller_.exchange(1,",
     order,
     {},
     "who reads the 0 before it also reads no later one, and the store of 0 that ends the polling is in "
     "order"},
    {worker, "has_poller_.exchange(1,", no_store, {}, "two workers poll instead of one"},
    {worker, "^has_poller_.store(0,", order, {}, "in stop_polling(), which corrects `polling` itself"},
    {worker, "^has_poller_.store(0,", no_store, {}, "no worker polls any more: each call is rung"},
    {worker,
     "polling.store(value,",
     no_store,
     {},
     "never says `yes` either: callers ring, or do so before they sleep, as with a `soon` that was broken"},
    {worker, "layout::WorkerPolling::soon), std::memory_order_relaxed", no_store, {}, costs},
};

TEST_CASE("Each weakened order or removed step of the call queue is caught or listed with a reason") {
    check_mutations(call_cases(), spared, 8000, 300);
}

} // namespace
} // namespace tandem::shm::model::call_mutation

// SPDX-License-Identifier: Apache-2.0
// Checks that the model check of the ring detects damaged code. Every access of the shipping code is weakened or broken, one at
// a time.
#include "tests/shm/model/mutation/mutation_check.hpp"
#include "tests/shm/model/scenarios/ring_scenarios.hpp"

namespace tandem::shm::model::ring_mutation {
namespace {

constexpr auto order = Damage::weaker_order, failure = Damage::weaker_failure, no_store = Damage::no_store;
constexpr const char* consumer = "ring_consumer.hpp";
constexpr const char* producer = "ring_producer.hpp";
constexpr const char* parser = "record_parser.hpp";

constexpr const char* second_line = "the compare-exchanges on the tail alone tell a torn copy: one that "
                                    "succeeds has read the newest tail, and its "
                                    "release and the writer's acquire order the copy before what overwrites "
                                    "it. The order of each word says the same "
                                    "once more, by happens-before only, and is free on x86-64";
constexpr const char* start = "before the first look at a record, which has an acquire of its own";

constexpr const char* observers = "for observers, which are outside of the model: ring_follower_test.cpp";

const std::vector<Spared> spared{
    {producer, "shared.write_limit.store(", no_store, {}, observers},
    {producer, "filled_for.store(", no_store, {}, observers},
    {consumer, "A::copy_atomic_from_shared(", order, {}, second_line},
    {consumer, "std::uint64_t stamp = A::load(", order, {}, second_line},
    {consumer, "stamp_ = A::load(", order, {}, second_line},
    {producer, "A::copy_atomic_to_shared(", order, {}, second_line},
    {producer, "A::store(*to, first,", order, {}, second_line},
    {producer, "stamp, std::memory_order_release", order, {}, "the commit word behind it publishes both"},
    {producer, "A::store(*ring_.cell(position), 0,", order, {}, "the commit word behind it publishes both"},
    {parser,
     "word = A::load(*ring.cell(position), std::memory_order_acquire);",
     order,
     {},
     "behind padding: the padding's word was stored after this one, and its load has acquired it"},
    {consumer,
     "CommitWord::unpack(A::load(*ring_.cell(tail)",
     order,
     {},
     "the tail was acquired, and this word was stored before the tail came to it"},
    {consumer, "tail.compare_exchange_strong(from, to,", order, Order::release,
     "what was copied was acquired with the commit word"},
    {consumer,
     "tail.compare_exchange_strong(from, to,",
     failure,
     {},
     "everything is read again, with acquire"},
    {consumer, "position_ = shared.tail.load(", order, {}, start},
    {"chunk_lease.hpp",
     "ring.chunk_words[i].returned.store(sequence - 1",
     order,
     {},
     "a skipped chunk was not read; what was read of an earlier use was released when that was given back"},
    {producer, "shared.head.load(", order, {}, "written by this side itself"},
    {producer, "const bool dropped =", order, Order::release,
     "the tail it finds was acquired when it was read"},
    {consumer, "shared->depth.store(", no_store, {}, observers},
    {producer, "shared.head.store(", order, {}, "for observers, and for the next writer of this side"},
};

TEST_CASE("Each weakened order or removed step of the ring is caught or listed with a reason") {
    check_mutations(ring_cases(), spared, 150, 2000);
}

} // namespace
} // namespace tandem::shm::model::ring_mutation

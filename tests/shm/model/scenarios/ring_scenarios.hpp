// SPDX-License-Identifier: Apache-2.0
// The scenarios of the ring; also what the mutation test runs.
#pragma once
#include "tests/shm/model/scenarios/case.hpp"
#include "tests/shm/model/scenarios/ring_world.hpp"

namespace tandem::shm::model {

struct RingPlan {
    const char* name;
    RingShape shape;
    std::vector<std::size_t> writes; ///< bytes of each record
    int reads = 3;
    enum class How { one_by_one, newest, mixed, batch, peek, polling } how = How::one_by_one;
    enum class Dies { nobody, writer, reader } dies = Dies::nobody;
    bool in_place = false;
    bool small = true; ///< a search of it is complete in the default size of a test
};

inline void run_ring(const RingPlan& plan, Execution& execution) {
    using How = RingPlan::How;
    using Dies = RingPlan::Dies;
    RingWorld world(execution, plan.shape);
    const bool waits = plan.shape.policy == RingPolicy::wait;
    execution.thread(
        "writer",
        [&] {
            for (const std::size_t bytes : plan.writes) {
                const bool written =
                    plan.in_place ? world.write_in_place(RingWorld::two_lines, bytes) : world.write(bytes);
                if (waits && plan.dies == Dies::nobody)
                    world.require(written, "a writer that waits finds room in the end");
            }
        },
        0, plan.dies == Dies::writer);
    execution.thread(
        "reader",
        [&] {
            for (int i = 0; i < plan.reads; ++i) {
                bool more = true;
                switch (plan.how) {
                case How::one_by_one:
                    world.read();
                    break;
                case How::newest:
                    world.read(true);
                    break;
                case How::mixed:
                    world.read(i % 2 == 0);
                    break;
                case How::batch:
                    world.consume(2);
                    break;
                case How::peek:
                    world.peek_and_release();
                    break;
                case How::polling:
                    while ((more = world.last() < plan.writes.size()) &&
                           (world.reader->empty() || !world.read()))
                        ModelAtomics::pause();
                    break;
                }
                if (!more) break;
            }
        },
        0, plan.dies == Dies::reader);
    execution.run();
    // A dead reader's ring gets no other one.
    if (execution.died(2)) return world.check_writer();
    world.check_at_end(!execution.died(1));
}

/// A writer that waits polls first; that its time to poll is over must not mean that the reader has come to
/// rest.
inline Settings settings_of(const RingPlan& plan) {
    Settings settings;
    settings.lapses = plan.shape.policy == RingPolicy::wait ? 1 : 0;
    return settings;
}

inline std::vector<Case> ring_cases() {
    using How = RingPlan::How;
    using Dies = RingPlan::Dies;
    constexpr auto newest = RingPolicy::latest_only, oldest = RingPolicy::drop_oldest,
                   reject = RingPolicy::reject, wait = RingPolicy::wait;
    constexpr std::size_t one = RingWorld::one_line, two = RingWorld::two_lines, big = RingWorld::chunk_bytes;
    const auto large = [](RingPlan plan) {
        plan.small = false;
        return plan;
    };
    const std::vector<RingPlan> plans{
        {"reject: three records", {reject}, {one, one, one}},
        {"reject: more records than room", {reject, 2, 1, 48}, {one, one, one}},
        {"reject: padding at the end", {reject, 4, 3}, {two, one, two}},
        {"reject: in place with less than was reserved",
         {reject, 4, 2, 112, 0},
         {one, one, one},
         3,
         How::one_by_one,
         Dies::nobody,
         true},
        {"reject: batches", {reject, 4, 1}, {one, two, one}, 2, How::batch},
        {"reject: looked at in place", {reject, 2, 0, 48}, {one, one, one}, 3, How::peek},
        {"reject: a polling reader", {reject, 4, 2}, {two, one}, 2, How::polling},
        {"reject: newest", {reject, 4, 2}, {one, two, one}, 2, How::newest},
        {"reject: the writer is killed", {reject, 4, 3}, {two, one, two}, 3, How::one_by_one, Dies::writer},
        {"reject: the reader is killed",
         {reject, 2, 0, 48},
         {one, one, one},
         3,
         How::one_by_one,
         Dies::reader},
        {"reject: loans", {reject, 4, 0, 48, 4096, 2 * Execution::never, 2}, {big, big, big}, 3},
        large({"wait: three records in room for one", {wait, 2, 0, 48}, {one, one, one}, 3, How::polling}),
        {"wait: two records in room for one", {wait, 2, 0, 48}, {one, one}, 2, How::polling},
        {"wait: batches", {wait, 4, 3}, {two, two}, 3, How::polling},
        large({"wait: the reader is killed",
               {wait, 2, 0, 48, 4096, RingWorld::second},
               {one, one, one},
               3,
               How::one_by_one,
               Dies::reader}),
        large({"wait: loans",
               {wait, 4, 0, 48, 4096, 2 * Execution::never, 2},
               {big, big, big},
               3,
               How::polling}),
        {"drop oldest: three records in room for one", {oldest, 2, 1, 48}, {one, one, one}},
        {"drop oldest: four records in room for three", {oldest, 4, 2, 48}, {one, one, one, one}, 2},
        large({"drop oldest: padding at the end", {oldest, 4, 3}, {two, one, two}, 2}),
        {"drop oldest: by turns the newest", {oldest, 4, 0}, {one, two, one}, 3, How::mixed},
        large({"drop oldest: a polling reader", {oldest, 2, 0, 48}, {one, one, one}, 3, How::polling}),
        large({"drop oldest: the writer is killed",
               {oldest, 2, 1, 48},
               {one, one, one},
               2,
               How::one_by_one,
               Dies::writer}),
        large({"drop oldest: the reader is killed",
               {oldest, 2, 1, 48},
               {one, one, one},
               2,
               How::one_by_one,
               Dies::reader}),
        {"drop oldest: two records in room for one and the writer is killed",
         {oldest, 2, 1, 48},
         {one, one},
         2,
         How::one_by_one,
         Dies::writer},
        {"drop oldest: two records in room for one and the reader is killed",
         {oldest, 2, 1, 48},
         {one, one},
         2,
         How::one_by_one,
         Dies::reader},
        {"latest only: two records in room for one", {newest, 2, 1, 48}, {one, one}, 3, How::newest},
        {"drop oldest: loans", {oldest, 4, 0, 48, 4096, 2 * Execution::never, 2}, {big, big, big}, 2},
        large({"latest only: three records in room for one",
               {newest, 2, 1, 48},
               {one, one, one},
               3,
               How::newest}),
        {"latest only: seven records", {newest, 8, 0, 48}, {one, one, one, one, one, one, one}, 1},
        {"latest only: three records", {newest, 4, 2}, {one, one, two}, 2},
        large({"latest only: the writer is killed",
               {newest, 4, 3},
               {two, one, two},
               2,
               How::newest,
               Dies::writer}),
    };
    std::vector<Case> cases;
    for (const auto& plan : plans)
        cases.push_back({plan.name, [plan](Execution& execution) { run_ring(plan, execution); },
                         settings_of(plan), plan.small});
    cases.push_back({"reject: a writer that comes late", [](Execution& execution) {
                         RingWorld world(execution, {reject, 4, 0, 48});
                         for (int i = 0; i < 3; ++i) world.write(one);
                         execution.thread("writer", [&] {
                             world.new_writer();
                             for (int i = 0; i < 2; ++i) world.write(one);
                         });
                         execution.thread("reader", [&] {
                             for (int i = 0; i < 3; ++i) world.read();
                         });
                         execution.run();
                         world.check_at_end();
                     }});
    return cases;
}

} // namespace tandem::shm::model

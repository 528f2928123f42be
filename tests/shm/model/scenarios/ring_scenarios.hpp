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
    enum class How { one_by_one, newest, mixed, polling } how = How::one_by_one;
    enum class Dies { nobody, writer, reader } dies = Dies::nobody;
    bool reserves = false;
    bool small = true; ///< a search of it is complete in the default size of a test
    std::uint64_t depth = 0;
};

inline void run_ring(const RingPlan& plan, Execution& execution) {
    using How = RingPlan::How;
    using Dies = RingPlan::Dies;
    RingWorld world(execution, plan.shape);
    if (plan.depth != 0) world.set_depth(plan.depth);
    execution.thread(
        "writer",
        [&] {
            for (const std::size_t bytes : plan.writes) {
                if (plan.reserves)
                    world.write_reserved(RingWorld::two_lines, bytes);
                else
                    world.write(bytes);
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
    world.check_at_end(!execution.died(1), plan.how == How::newest);
}

inline std::vector<Case> ring_cases() {
    using How = RingPlan::How;
    using Dies = RingPlan::Dies;
    constexpr std::size_t one = RingWorld::one_line, two = RingWorld::two_lines, big = RingWorld::chunk_bytes;
    const auto large = [](RingPlan plan) {
        plan.small = false;
        return plan;
    };
    std::vector<RingPlan> plans{
        {"three records", {}, {one, one, one}},
        {"three records in room for one", {2, 1, 48}, {one, one, one}},
        {"four records in room for three", {4, 2, 48}, {one, one, one, one}, 2},
        large({"padding at the end", {4, 3}, {two, one, two}, 2}),
        {"reserved with less than that used", {4, 2}, {one, one}, 2, How::one_by_one, Dies::nobody, true},
        {"every second read the newest", {4, 0}, {one, two, one}, 3, How::mixed},
        large({"a polling reader", {2, 0, 48}, {one, one, one}, 3, How::polling}),
        large({"the writer is killed", {2, 1, 48}, {one, one, one}, 2, How::one_by_one, Dies::writer}),
        large({"the reader is killed", {2, 1, 48}, {one, one, one}, 2, How::one_by_one, Dies::reader}),
        {"two records in room for one and the writer is killed",
         {2, 1, 48},
         {one, one},
         2,
         How::one_by_one,
         Dies::writer},
        {"two records in room for one and the reader is killed",
         {2, 1, 48},
         {one, one},
         2,
         How::one_by_one,
         Dies::reader},
        {"chunks", {4, 0, 48, 2}, {big, big, big}, 2},
        {"newest: two records in room for one", {2, 1, 48}, {one, one}, 3, How::newest},
        large({"newest: three records in room for one", {2, 1, 48}, {one, one, one}, 3, How::newest}),
        {"newest: seven records", {8, 0, 48}, {one, one, one, one, one, one, one}, 1, How::newest},
        {"newest: three records", {4, 2}, {one, one, two}, 2, How::newest},
        large({"newest: the writer is killed", {4, 3}, {two, one, two}, 2, How::newest, Dies::writer}),
        large({"newest: chunks", {4, 0, 48, 3}, {big, big, big}, 2, How::newest}),
    };
    const auto with_depth = [](std::uint64_t depth, RingPlan plan) {
        plan.depth = depth;
        return plan;
    };
    const std::vector<RingPlan> plans_with_depth{
        with_depth(1, {"depth of one: three records", {4, 2, 48}, {one, one, one}, 2}),
        with_depth(2, {"depth of two: four records in room for three", {4, 2, 48}, {one, one, one, one}, 2}),
        with_depth(2, large({"depth of two: padding", {8, 5}, {two, one, two, one}, 2})),
        with_depth(2, large({"depth of two: the writer is killed",
                             {4, 2, 48},
                             {one, one, one, one},
                             2,
                             How::one_by_one,
                             Dies::writer})),
        with_depth(2, large({"depth of two: chunks", {4, 0, 48, 3}, {big, big, big}, 2})),
    };
    plans.insert(plans.end(), plans_with_depth.begin(), plans_with_depth.end());
    std::vector<Case> cases;
    for (const auto& plan : plans)
        cases.push_back(
            {plan.name, [plan](Execution& execution) { run_ring(plan, execution); }, Settings{}, plan.small});
    cases.push_back({"a writer that comes late", [](Execution& execution) {
                         RingWorld world(execution, {4, 0, 48});
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

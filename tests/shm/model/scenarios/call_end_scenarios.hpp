// SPDX-License-Identifier: Apache-2.0
// Calls that are given up, cancelled, refused, and whose caller or worker dies.
#pragma once
#include "tests/shm/model/scenarios/call_world.hpp"
#include "tests/shm/model/scenarios/case.hpp"

namespace tandem::shm::model {

inline std::vector<Case> call_end_cases() {
    using End = CallWorld::End;
    constexpr std::uint64_t second = CallWorld::second;
    std::vector<Case> cases;

    cases.push_back({"a caller gives up at its deadline and calls again in the same slot",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] {
                             ends[1] = world.call(1, second);
                             ends[2] = world.call(2, second);
                             world.worker.end_all_waits();
                         });
                         execution.thread("worker", [&] { world.serve(2); });
                         world.run(ends, {End::answered, End::timeout, End::overload});
                     },
                     Settings{.lapses = 1}});

    cases.push_back({"the queue is closed while a call comes",
                     [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] { ends[1] = world.call(1, CallWorld::far(1)); });
                         execution.thread("closer", [&] {
                             world.worker.close();
                             world.look(1);
                         });
                         execution.run();
                         world.expect(ends, {End::answered, End::closed});
                     },
                     Settings{}, true});

    cases.push_back({"the callers are killed anywhere",
                     [](Execution& execution) {
                         CallWorld world(execution);
                         execution.thread(
                             "caller 1", [&] { world.call(1, CallWorld::far(1)); }, 1, true);
                         execution.thread(
                             "caller 2", [&] { world.call(2, CallWorld::far(2)); }, 1, true);
                         execution.thread("worker", [&] {
                             world.look(2);
                             if (!execution.lives(1)) world.worker.drop_submitted();
                             world.look(1);
                         });
                         execution.run();
                     },
                     Settings{.ends_in_sleep = true}});

    cases.push_back({"the worker is killed anywhere", [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::Ends ends;
                         execution.thread(
                             "worker", [&] { world.serve(2); }, 0, true);
                         execution.thread("caller", [&] {
                             ends[1] = world.call(1, CallWorld::far(1), 0, 1);
                             ends[2] = world.call(2, CallWorld::far(2), 0, 1);
                         });
                         execution.run();
                         world.expect(ends, {End::answered, End::peer_died});
                         world.check(ends, true);
                     }});

    cases.push_back({"a caller gives up and calls again and two workers work",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] {
                             ends[1] = world.call(1, second);
                             ends[2] = world.call(2, second);
                         });
                         for (const char* name : {"worker 1", "worker 2"})
                             execution.thread(name, [&] { world.look(3); });
                         world.run(ends, {End::answered, End::timeout, End::overload});
                     },
                     Settings{.lapses = 1}});

    cases.push_back({"a new calling end takes over from one that left calls behind",
                     [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::Ends ends;
                         CallTicket left;
                         world.begin(1, CallWorld::far(1), 0, false, left);
                         world.begin(2, CallWorld::far(2), 1, false, left);
                         execution.thread("worker", [&] { world.look(3); });
                         execution.thread("successor", [&] {
                             CallCaller<CallWorld::A> successor(world.view());
                             for (std::uint32_t id = 3; id < 5; ++id) {
                                 CallTicket ticket;
                                 world.begin(successor, id, CallWorld::far(id), 0, false, ticket);
                             }
                         });
                         execution.run();
                     },
                     Settings{}, true});

    cases.push_back({"a running call is given up and its slot used again",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         CallTicket ticket;
                         world.begin(1, CallWorld::far(1), 0, false, ticket);
                         bool polling = false;
                         const auto running = world.take(polling);
                         execution.thread("worker 1", [&] { world.answer(*running); });
                         execution.thread("caller", [&] {
                             if (!world.caller.withdraw(ticket)) world.caller.finish(ticket);
                             ends[2] = world.begin(2, CallWorld::far(2), 0, false, ticket);
                             if (ends[2] == End::answered) ends[2] = world.wait(2, ticket, 0, true);
                             world.worker.end_all_waits();
                         });
                         execution.thread("worker 2", [&] { world.serve(1); });
                         world.run(ends, {End::answered, End::overload});
                     },
                     Settings{}, true});

    cases.push_back({"a worker says how far two calls of one slot are",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         execution.thread("worker", [&] { world.serve(2, false, true); });
                         execution.thread("caller", [&] {
                             for (std::uint32_t id = 1; id <= 2; ++id) {
                                 CallTicket ticket;
                                 world.begin(id, CallWorld::far(id), 0, true, ticket);
                                 world.expect_progress(id, ticket);
                                 ends[id] = world.wait(id, ticket);
                             }
                         });
                         world.run(ends, {End::answered});
                     },
                     Settings{}});

    cases.push_back({"a worker finds that its call was given up",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         CallTicket ticket;
                         world.begin(1, CallWorld::far(1), 0, false, ticket);
                         bool polling = false;
                         const auto running = world.take(polling);
                         execution.require(!world.worker.unwanted(*running), "the caller waits");
                         execution.thread("worker", [&] {
                             while (!world.worker.unwanted(*running)) CallWorld::A::pause();
                             world.answer(*running);
                         });
                         execution.thread("caller", [&] {
                             if (!world.caller.withdraw(ticket)) world.caller.finish(ticket);
                             ends[2] = world.begin(2, CallWorld::far(2), 0, false, ticket);
                         });
                         execution.run();
                         world.look(1);
                         if (ends[2] == End::answered) ends[2] = world.wait(2, ticket, 0, true);
                         world.expect(ends, {End::answered, End::overload});
                         world.check(ends);
                     },
                     Settings{}, true});

    cases.push_back({"a call is given up while two workers look at it",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         CallTicket ticket;
                         world.begin(1, CallWorld::far(1), 0, false, ticket);
                         for (const char* name : {"worker 1", "worker 2"})
                             execution.thread(name, [&] { world.look(1); });
                         execution.thread("caller", [&] {
                             if (!world.caller.withdraw(ticket)) world.caller.finish(ticket);
                             ends[2] = world.begin(2, CallWorld::far(2), 0, false, ticket);
                         });
                         execution.run();
                         world.look(1);
                         if (ends[2] == End::answered) ends[2] = world.wait(2, ticket, 0, true);
                         world.expect(ends, {End::answered, End::overload});
                         world.check(ends);
                     },
                     Settings{}, true});

    return cases;
}

} // namespace tandem::shm::model

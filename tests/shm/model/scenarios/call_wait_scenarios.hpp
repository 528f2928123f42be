// SPDX-License-Identifier: Apache-2.0
// Calls that are answered: which threads sleep, which one polls, which one is woken.
#pragma once
#include "tests/shm/model/scenarios/call_world.hpp"
#include "tests/shm/model/scenarios/case.hpp"

namespace tandem::shm::model {

inline std::vector<Case> call_wait_cases() {
    using End = CallWorld::End;
    std::vector<Case> cases;

    cases.push_back({"one caller calls and sleeps and the worker sleeps",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] { ends[1] = world.call(1, CallWorld::far(1)); });
                         execution.thread("worker", [&] { world.serve(1); });
                         world.run(ends, {End::answered});
                     },
                     Settings{}, true});

    cases.push_back({"one caller calls twice and sleeps and the worker sleeps", [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] {
                             ends[1] = world.call(1, CallWorld::far(1));
                             ends[2] = world.call(2, CallWorld::far(2));
                         });
                         execution.thread("worker", [&] { world.serve(2); });
                         world.run(ends, {End::answered});
                     }});

    cases.push_back({"two callers and one worker", [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::Ends ends{{1, End::closed}, {2, End::closed}};
                         execution.thread("caller 1", [&] { ends[1] = world.call(1, CallWorld::far(1)); });
                         execution.thread("caller 2", [&] { ends[2] = world.call(2, CallWorld::far(2)); });
                         execution.thread("worker", [&] { world.serve(2); });
                         world.run(ends, {End::answered});
                     }});

    cases.push_back(
        {"one caller and two workers, of which one calls end_all_waits()", [](Execution& execution) {
             CallWorld world(execution);
             CallWorld::Ends ends;
             execution.thread("caller", [&] {
                 ends[1] = world.call(1, CallWorld::far(1));
                 world.worker.end_all_waits();
             });
             execution.thread("worker 1", [&] { world.serve(2); });
             execution.thread("worker 2", [&] { world.serve(2); });
             world.run(ends, {End::answered});
         }});

    cases.push_back({"two workers of which one polls",
                     [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] {
                             ends[1] = world.call(1, CallWorld::far(1));
                             world.worker.end_all_waits();
                         });
                         execution.thread("worker 1", [&] { world.serve(2, true); });
                         execution.thread("worker 2", [&] { world.serve(2, true); });
                         world.run(ends, {End::answered});
                     },
                     Settings{.lapses = 1}});

    cases.push_back({"a caller polls and the worker sleeps",
                     [](Execution& execution) {
                         CallWorld world(execution, 1);
                         CallWorld::Ends ends;
                         execution.thread("caller", [&] {
                             for (const std::uint32_t id : {1U, 2U}) {
                                 CallTicket ticket;
                                 world.begin(id, CallWorld::far(id), 0, false, ticket);
                                 ends[id] = world.wait(id, ticket, 0, true);
                             }
                         });
                         execution.thread("worker", [&] { world.serve(2); });
                         world.run(ends, {End::answered});
                     },
                     Settings{}, true});

    cases.push_back({"two callers and two workers of which one polls",
                     [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::A::Atomic<std::uint32_t> finished{0};
                         CallWorld::Ends ends{{1, End::closed}, {2, End::closed}};
                         for (const std::uint32_t id : {1U, 2U})
                             execution.thread("caller " + std::to_string(id), [&, id] {
                                 ends[id] = world.call(id, CallWorld::far(id));
                                 if (finished.fetch_add(1, Order::relaxed) == 1) world.worker.end_all_waits();
                             });
                         execution.thread("worker 1", [&] { world.serve(9, true); });
                         execution.thread("worker 2", [&] { world.serve(9, true); });
                         world.run(ends, {End::answered});
                     },
                     Settings{.lapses = 1}});

    cases.push_back({"callers poll and one of two workers polls",
                     [](Execution& execution) {
                         CallWorld world(execution);
                         CallWorld::A::Atomic<std::uint32_t> finished{0};
                         CallWorld::Ends ends{{1, End::closed}, {2, End::closed}};
                         for (const std::uint32_t id : {1U, 2U})
                             execution.thread("caller " + std::to_string(id), [&, id] {
                                 CallTicket ticket;
                                 world.begin(id, CallWorld::far(id), id - 1, false, ticket);
                                 ends[id] = world.wait(id, ticket, 0, true);
                                 if (finished.fetch_add(1, Order::relaxed) == 1) world.worker.end_all_waits();
                             });
                         execution.thread("worker 1", [&] { world.serve(9, true); });
                         execution.thread("worker 2", [&] { world.serve(9, true); });
                         world.run(ends, {End::answered});
                     },
                     Settings{.lapses = 1}});

    cases.push_back({"the worker that is expected back does not come",
                     [](Execution& execution) {
                         using A = CallWorld::A;
                         CallWorld world(execution);
                         A::Atomic<std::uint32_t> finished{0};
                         CallWorld::Ends ends;
                         execution.thread("worker 1", [&] {
                             world.serve(1, true);
                             while (finished.load(Order::seq_cst) == 0)
                                 A::futex_wait(finished, 0, CallWorld::never);
                         });
                         execution.thread("worker 2", [&] { world.serve(9, true); });
                         execution.thread("caller", [&] {
                             for (const std::uint32_t id : {1U, 2U})
                                 ends[id] = world.call(id, CallWorld::far(id));
                             finished.store(1, Order::seq_cst);
                             A::futex_wake(finished, 1);
                             world.worker.end_all_waits();
                         });
                         world.run(ends, {End::answered});
                     },
                     Settings{.lapses = 1}});

    for (const bool polls : {true, false})
        cases.push_back({polls ? "the worker that polled goes off while callers poll"
                               : "the worker that polled goes off while callers sleep",
                         [polls](Execution& execution) {
                             using A = CallWorld::A;
                             CallWorld world(execution);
                             A::Atomic<std::uint32_t> finished{0};
                             CallWorld::Ends ends{{1, End::closed}, {2, End::closed}};
                             execution.thread("worker 1", [&] {
                                 world.serve(1, true);
                                 for (auto seen = finished.load(Order::seq_cst); seen < 2;
                                      seen = finished.load(Order::seq_cst))
                                     A::futex_wait(finished, seen, CallWorld::never);
                             });
                             execution.thread("worker 2", [&] { world.serve(9, true); });
                             for (const std::uint32_t id : {1U, 2U})
                                 execution.thread("caller " + std::to_string(id), [&, id] {
                                     CallTicket ticket;
                                     world.begin(id, CallWorld::far(id), id - 1, !polls, ticket);
                                     ends[id] = world.wait(id, ticket, 0, polls);
                                     const auto before = finished.fetch_add(1, Order::seq_cst);
                                     A::futex_wake(finished, 1);
                                     if (before == 1) world.worker.end_all_waits();
                                 });
                             world.run(ends, {End::answered});
                         },
                         Settings{.lapses = 1}});

    // The case to exclude: a thread is about to sleep while the poller leaves and no other thread sleeps yet. Neither the
    // poller nor a later caller, which still relies on the poller, would wake it.
    for (const bool before : {true, false})
        cases.push_back({before ? "the worker that has been polling leaves while its colleague lies down"
                                : "the worker that polls leaves while its colleague lies down",
                         [before](Execution& execution) {
                             CallWorld world(execution);
                             CallWorld::Ends ends;
                             CallTicket first, second;
                             world.begin(1, CallWorld::far(1), 0, false, first);
                             bool polling = before && world.worker.try_become_poller();
                             std::optional<TakenCall> held;
                             execution.thread("worker 1", [&] {
                                 polling = polling || world.worker.try_become_poller();
                                 held = world.take(polling);
                                 if (polling) world.worker.stop_polling();
                                 if (held && CallWorld::id_of(*held) == 1) return; // for long
                                 if (held) world.answer(*held);
                                 held.reset();
                                 world.serve(9);
                             });
                             execution.thread("worker 2", [&] { world.serve(9); });
                             execution.thread("caller", [&] {
                                 world.begin(2, CallWorld::far(2), 1, false, second);
                                 ends[2] = world.wait(2, second, 0, true);
                                 world.worker.end_all_waits();
                             });
                             execution.run();
                             if (held) world.answer(*held);
                             ends[1] = world.wait(1, first);
                             world.expect(ends, {End::answered});
                             world.check(ends);
                         }});

    return cases;
}

} // namespace tandem::shm::model

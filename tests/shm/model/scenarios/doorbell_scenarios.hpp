// SPDX-License-Identifier: Apache-2.0
// All scenarios of the doorbell.
#pragma once
#include "tests/shm/model/scenarios/case.hpp"
#include "tests/shm/model/scenarios/doorbell_world.hpp"

namespace tandem::shm::model {

struct DoorbellPlan {
    const char* name;
    unsigned ports;
    std::function<void(DoorbellWorld&)> owner;
    std::vector<std::function<void(DoorbellWorld&)>> ringers; ///< threads of one process
    WaitMode mode = WaitMode::futex;
    unsigned lapses = 0;
    bool mortal = false; ///< the ringers' process may be killed, and a thread of the owner's interrupts
    bool small = true;   ///< a search of it is complete in the default size of a test
};

inline std::vector<Case> doorbell_cases() {
    using World = DoorbellWorld;
    using std::chrono::milliseconds;
    static constexpr WaitOptions futex{WaitMode::futex};
    const auto publish = [](std::initializer_list<unsigned> ports) {
        return [ports = std::vector<unsigned>(ports)](World& world) {
            for (const unsigned port : ports) world.publish(port);
        };
    };
    const auto batch = [](World& world) {
        for (const unsigned port : {0U, 1U}) world.put(port);
        world.theirs.ring_all({0, 1});
    };
    const auto ring_in_two_words = [](World& world) {
        for (const unsigned bit : {1U, 64U}) world.theirs.ring(bit);
    };

    const auto wait = [](World& world) { world.wait(); };
    const auto look = [](World& world) { world.look(); };
    const auto wait_in_two_words = [](World& world) {
        for (ReadyBits bits; !(bits.test(1) && bits.test(64));)
            bits |= world.mine.wait(World::for_ever, futex);
    };
    const auto look_then_wait = [](World& world) { world.look(1), world.wait(); };
    const auto wait_then_look = [](World& world) { world.wait(1), world.look(); };
    const auto give_up_then_wait = [](World& world) { world.look_once(milliseconds(1)), world.wait(); };
    const auto give_up_then_look = [](World& world) { world.look_once(milliseconds(1)), world.look(); };
    const auto wait_for_interrupt = [](World& world) {
        while (!world.mine.wait(World::for_ever, futex).test(World::Bell::interrupt_bit)) {
        }
    };
    const auto look_for_interrupt = [](World& world) {
        const auto never = [] { return false; };
        while (!world.mine.wait_for(never, World::for_ever, futex).test(World::Bell::interrupt_bit)) {
        }
    };

    const auto large = [](DoorbellPlan plan) { return plan.small = false, plan; };
    const auto late = [](DoorbellPlan plan) { return plan.lapses = 1, plan; };
    const auto killed = [](DoorbellPlan plan) { return plan.mortal = true, plan; };
    const std::vector<DoorbellPlan> plans{
        {"bits: one port", 1, wait, {publish({0})}},
        {"bits: two ports one after the other", 2, wait, {publish({0, 1})}},
        large({"bits: two ringers", 2, wait, {publish({0}), publish({1})}}),
        {"bits: a batch", 2, wait, {batch}},
        {"bits: two ports in two words", 2, wait_in_two_words, {ring_in_two_words}},
        late({"bits: polls and then sleeps", 2, wait, {publish({0, 1})}, WaitMode::spin_then_futex}),
        late({"bits: on one core", 1, wait, {publish({0})}, WaitMode::same_core}),
        {"bits: polls", 2, wait, {publish({0, 1})}, WaitMode::spin},
        {"looks: one port", 1, look, {publish({0})}},
        large({"looks: two ports one after the other", 2, look, {publish({0, 1})}}),
        large({"looks: three ports one after the other", 3, look, {publish({0, 1, 2})}}),
        large({"looks: two ringers", 2, look, {publish({0}), publish({1})}}),
        large({"looks: two ringers, one of them twice", 3, look, {publish({0, 1}), publish({2})}}),
        large(late({"looks: polls and then sleeps", 2, look, {publish({0, 1})}, WaitMode::spin_then_futex})),
        {"looks: polls", 2, look, {publish({0, 1})}, WaitMode::spin},
        {"looks and then waits for bits, two ports", 2, look_then_wait, {publish({0, 1})}},
        large({"looks and then waits for bits, three ports", 3, look_then_wait, {publish({0, 1, 2})}}),
        {"waits for bits and then looks, two ports", 2, wait_then_look, {publish({0, 1})}},
        large({"waits for bits and then looks, three ports", 3, wait_then_look, {publish({0, 1, 2})}}),
        large(late({"looks to its bound and then waits for bits", 2, give_up_then_wait, {publish({0, 1})}})),
        large(late({"looks to its bound and then looks again", 2, give_up_then_look, {publish({0, 1})}})),
        killed({"bits: an interrupt, and the ringer is killed", 1, wait_for_interrupt, {publish({0})}}),
        large(
            killed({"looks: an interrupt, and the ringer is killed", 1, look_for_interrupt, {publish({0})}})),
    };
    std::vector<Case> cases;
    for (const auto& plan : plans)
        cases.push_back({plan.name,
                         [plan](Execution& execution) {
                             World world(execution, plan.ports, {.mode = plan.mode});
                             execution.thread("owner", [&] { plan.owner(world); });
                             for (std::size_t i = 0; i < plan.ringers.size(); ++i)
                                 execution.thread(
                                     "ringer " + std::to_string(i + 1), [&, i] { plan.ringers[i](world); }, 1,
                                     plan.mortal);
                             if (plan.mortal) execution.thread("colleague", [&] { world.mine.interrupt(); });
                             execution.run();
                         },
                         Settings{.lapses = plan.lapses}, plan.small});
    return cases;
}

} // namespace tandem::shm::model

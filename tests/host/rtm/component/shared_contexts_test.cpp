// SPDX-License-Identifier: Apache-2.0
// Execution contexts of equal rate that share threads, as those of more than 16 components do.
#include "tests/host/rtm/manager_fixture.hpp"
#include <atomic>
#include <rtm/PeriodicExecutionContext.h>
#include <set>

using namespace testing;

namespace {

/// Counts its cycles and notes the thread of the last one. Acts on its own context in the next cycle if `act` is set.
struct Member : RTC::DataFlowComponentBase {
    enum class Act : int { nothing, deactivate, stop, change_rate };
    explicit Member(RTC::Manager* m) : DataFlowComponentBase(m) {}
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (inside.exchange(true)) ++overlaps;
        thread = std::this_thread::get_id();
        auto* context = getOwnContexts().at(0);
        const Act now = act.exchange(Act::nothing);
        if (now == Act::deactivate) context->deactivateComponent(RTC::RTObject_var(getObjRef()).in());
        if (now == Act::stop) context->stop();
        if (now == Act::change_rate) context->setRate(500);
        inside = false;
        ++cycles;
        return RTC::RTC_OK;
    }
    bool reaches(long count) const {
        for (int i = 0; i < 10000 && cycles < count; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return cycles >= count;
    }
    RTC_exp::PeriodicExecutionContext& context() {
        return dynamic_cast<RTC_exp::PeriodicExecutionContext&>(*getOwnContexts().at(0));
    }
    std::atomic<long> cycles{0}, overlaps{0};
    std::atomic<bool> inside{false};
    std::atomic<Act> act{Act::nothing};
    std::atomic<std::thread::id> thread{};
};

/// Fills the places of separate threads, then creates `count` members.
std::vector<Member*> members(ManagerFixture& fixture, int count) {
    register_component_type<Member>(fixture.manager(), "Member");
    for (int i = 0; i < 16; ++i) fixture.create<Member>("Member?exec_cxt.periodic.rate=1");
    std::vector<Member*> all;
    for (int i = 0; i < count; ++i)
        all.push_back(&fixture.create<Member>("Member?exec_cxt.periodic.rate=1000"));
    return all;
}

} // namespace

TEST_CASE("Contexts that share threads run, count and stop like those with separate threads") {
    ManagerFixture fixture(false);
    const auto all = members(fixture, 30);
    for (auto* each : all) REQUIRE(each->activate(0) == RTC::RTC_OK);
    std::set<std::thread::id> threads;
    for (auto* each : all) {
        REQUIRE(each->reaches(20));
        threads.insert(each->thread);
    }
    CHECK(threads.size() < all.size());
    for (auto* each : all) {
        REQUIRE(each->deactivate(0) == RTC::RTC_OK);
        each->context().stopThread();
        // The first execution is not that of a tick, and the last tick deactivates the component.
        CHECK(each->context().tickStatistics().cycles == static_cast<std::uint64_t>(each->cycles));
        CHECK(each->overlaps == 0);
    }
}

TEST_CASE("A context that shares a thread is deactivated, stopped, started and changed by its component") {
    ManagerFixture fixture(false);
    const auto all = members(fixture, 3);
    auto& one = *all[1];
    for (auto* each : all) REQUIRE(each->activate(0) == RTC::RTC_OK);
    one.act = Member::Act::change_rate;
    REQUIRE(one.reaches(one.cycles + 20));
    CHECK(one.context().getRate() == 500);
    one.act = Member::Act::deactivate;
    for (int i = 0; i < 10000 && ManagerFixture::state(one) != RTC::INACTIVE_STATE; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    REQUIRE(ManagerFixture::state(one) == RTC::INACTIVE_STATE);
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    REQUIRE(one.reaches(one.cycles + 5));
    one.act = Member::Act::stop;
    for (int i = 0; i < 10000 && one.context().isRunning(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(one.context().start() == RTC::RTC_OK);
    CHECK(one.reaches(one.cycles + 5));
    CHECK(all[0]->reaches(all[0]->cycles + 5));
    CHECK(one.overlaps == 0);
}

TEST_CASE("A component that waits in its cycle for another context of its thread is served") {
    struct Waiter : Member {
        explicit Waiter(RTC::Manager* m) : Member(m) {}
        RTC::ReturnCode_t onExecute(RTC::UniqueId id) override {
            if (auto* const awaited = other.exchange(nullptr)) served = awaited->reaches(awaited->cycles + 3);
            return Member::onExecute(id);
        }
        std::atomic<Member*> other{nullptr};
        std::atomic<bool> served{false};
    };
    ManagerFixture fixture(false);
    const auto all = members(fixture, 2);
    register_component_type<Waiter>(fixture.manager(), "Waiter");
    auto& waiter = fixture.create<Waiter>("Waiter?exec_cxt.periodic.rate=1000");
    for (auto* each : all) REQUIRE(each->activate(0) == RTC::RTC_OK);
    REQUIRE(waiter.activate(0) == RTC::RTC_OK);
    REQUIRE(waiter.reaches(5));
    waiter.other = all[0];
    REQUIRE(waiter.reaches(waiter.cycles + 5));
    CHECK(waiter.served);
    CHECK(all[1]->reaches(all[1]->cycles + 5));
}

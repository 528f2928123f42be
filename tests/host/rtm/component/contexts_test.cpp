// SPDX-License-Identifier: Apache-2.0
// The kinds of execution contexts: which thread runs a cycle, when, and what is counted.
#include "host/rt/periodic_tick.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <future>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/OpenHRPExecutionContext.h>
#include <rtm/PeriodicExecutionContext.h>
#include <set>

using namespace testing;

namespace {

/// Records the number of its cycles, their threads, and the rates of onRateChanged. Cycle `slow_cycle` takes
/// `slow_for`.
struct Ticker : RTC::DataFlowComponentBase {
    explicit Ticker(RTC::Manager* m) : DataFlowComponentBase(m) {}
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        std::lock_guard<std::mutex> lock(mutex);
        threads.insert(std::this_thread::get_id());
        if (++cycles == slow_cycle) std::this_thread::sleep_for(slow_for);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onRateChanged(RTC::UniqueId id) override {
        rates.push_back(getExecutionRate(id));
        return RTC::RTC_OK;
    }
    long count() {
        std::lock_guard<std::mutex> lock(mutex);
        return cycles;
    }
    std::mutex mutex;
    std::set<std::thread::id> threads;
    std::vector<double> rates;
    long cycles = 0, slow_cycle = -1;
    std::chrono::milliseconds slow_for{0};
};

Ticker& ticker(ManagerFixture& fixture, const std::string& arguments) {
    register_component_type<Ticker>(fixture.manager(), "Ticker");
    return fixture.create<Ticker>("Ticker?" + arguments);
}

bool reaches(Ticker& ticker, long cycles) {
    for (int i = 0; i < 10000 && ticker.count() < cycles; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return ticker.count() >= cycles;
}

template <class Context>
Context& context_of(RTC::RTObject_impl& rtc, std::size_t index = 0) {
    return dynamic_cast<Context&>(*rtc.getOwnContexts().at(index));
}

} // namespace

TEST_CASE("A periodic context counts its cycles, and those that were overrun") {
    ManagerFixture fixture(false);
    auto& one = ticker(fixture, "exec_cxt.periodic.rate=1000");
    one.slow_cycle = 5;
    one.slow_for = std::chrono::milliseconds(20);
    auto& context = context_of<RTC_exp::PeriodicExecutionContext>(one);
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    REQUIRE(reaches(one, 30));
    REQUIRE(one.deactivate(0) == RTC::RTC_OK);
    context.stopThread();
    const auto ticks = context.tickStatistics();
    // The first execution is not that of a tick, and the last tick deactivates the component.
    CHECK(ticks.cycles == static_cast<std::uint64_t>(one.count()));
    CHECK(ticks.overruns >= 1);
    CHECK(ticks.skipped >= 18);
    RTC::ExecutionContextProfile_var profile = context.getProfile();
    CHECK(NVUtil::toString(profile->properties, "tick.cycles") == std::to_string(ticks.cycles));
    CHECK(NVUtil::toString(profile->properties, "tick.overruns") == std::to_string(ticks.overruns));
}

TEST_CASE("Cycles and skipped periods together are all the periods there were: no drift") {
    ManagerFixture fixture(false);
    auto& one = ticker(fixture, "exec_cxt.periodic.rate=2000");
    auto& context = context_of<RTC_exp::PeriodicExecutionContext>(one);
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    REQUIRE(reaches(one, 10));
    const auto period = context.getPeriod();
    // The number of the present period of the grid, and the number of periods that the context has counted.
    auto sample = [&] {
        const auto now = std::chrono::steady_clock::now().time_since_epoch() - tandem::rt::grid_origin;
        const auto ticks = context.tickStatistics();
        return std::pair(now / period, ticks.cycles + ticks.skipped);
    };
    const auto before = sample();
    REQUIRE(reaches(one, 1000));
    const auto after = sample();
    const auto periods = static_cast<std::int64_t>(after.first - before.first);
    const auto counted = static_cast<std::int64_t>(after.second - before.second);
    // Periods that pass while a cycle is late are counted when that cycle starts: wait for the last of them.
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto later = sample();
    CHECK(periods + (later.first - after.first) >= counted);
    CHECK(static_cast<std::int64_t>(later.second - before.second) >= periods - 1);
}

TEST_CASE("A change of the rate is notified once, and cycles continue at the new rate") {
    ManagerFixture fixture(false);
    auto& one = ticker(fixture, "exec_cxt.periodic.rate=100");
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    CHECK(one.setExecutionRate(0, 500) == RTC::RTC_OK);
    CHECK(one.setExecutionRate(0, 0) == RTC::BAD_PARAMETER);
    CHECK(one.rates == std::vector<double>{500});
    CHECK(context_of<RTC_exp::PeriodicExecutionContext>(one).getPeriod() == std::chrono::milliseconds(2));
    REQUIRE(reaches(one, 20));
}

TEST_CASE("The rehearsal before a tick calls neither the component nor its listeners") {
    struct Actor : RTC::DataFlowComponentBase {
        explicit Actor(RTC::Manager* m) : DataFlowComponentBase(m) {}
        RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
            ++executed;
            return RTC::RTC_OK;
        }
        RTC::ReturnCode_t onStateUpdate(RTC::UniqueId) override {
            ++updated;
            return RTC::RTC_OK;
        }
        std::atomic<long> executed{0};
        long updated = 0, before_execute = 0, after_execute = 0, before_update = 0, after_update = 0;
    };
    struct Before : RTC::PreComponentActionListener {
        explicit Before(long& n) : calls(n) {}
        void operator()(RTC::UniqueId) override { ++calls; }
        long& calls;
    };
    struct After : RTC::PostComponentActionListener {
        explicit After(long& n) : calls(n) {}
        void operator()(RTC::UniqueId, RTC::ReturnCode_t) override { ++calls; }
        long& calls;
    };
    ManagerFixture fixture(false, {}, std::chrono::milliseconds(1));
    register_component_type<Actor>(fixture.manager(), "Actor");
    auto& one = fixture.create<Actor>("Actor?exec_cxt.periodic.rate=500");
    one.addPreComponentActionListener(RTC::PRE_ON_EXECUTE, new Before(one.before_execute));
    one.addPreComponentActionListener(RTC::PRE_ON_STATE_UPDATE, new Before(one.before_update));
    one.addPostComponentActionListener(RTC::POST_ON_EXECUTE, new After(one.after_execute));
    one.addPostComponentActionListener(RTC::POST_ON_STATE_UPDATE, new After(one.after_update));
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    for (int i = 0; i < 10000 && one.executed < 100; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    REQUIRE(one.deactivate(0) == RTC::RTC_OK);
    auto& context = context_of<RTC_exp::PeriodicExecutionContext>(one);
    context.stopThread();
    const long cycles = static_cast<long>(context.tickStatistics().cycles);
    CHECK(one.executed >= 100);
    CHECK(one.executed == cycles); // the first is not that of a tick, the last tick deactivates it
    CHECK(one.before_execute == one.executed);
    CHECK(one.after_execute == one.executed);
    CHECK(one.updated == one.executed);
    CHECK(one.before_update == one.executed);
    CHECK(one.after_update == one.executed);
}

TEST_CASE("A context that several threads start and stop at the same time ends in the state requested last") {
    ManagerFixture fixture(false);
    auto& one = ticker(fixture, "exec_cxt.periodic.rate=1000");
    REQUIRE(ManagerFixture::activate(one) == RTC::RTC_OK);
    auto& context = context_of<RTC_exp::PeriodicExecutionContext>(one);
    std::vector<std::thread> tools;
    for (int t = 0; t < 4; ++t)
        tools.emplace_back([&, t] {
            for (int i = 0; i < 200; ++i) t % 2 == 0 ? context.start() : context.stop();
        });
    for (auto& tool : tools) tool.join();
    context.stop();
    CHECK_FALSE(context.isRunning());
    const long stopped = one.count();
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // 20 cycles, if it still ran
    CHECK(one.count() == stopped);
    CHECK(context.start() == RTC::RTC_OK);
    CHECK(reaches(one, stopped + 5));
}

TEST_CASE("A component that stops its context within a cycle can be started again from outside only") {
    struct Stopper : RTC::DataFlowComponentBase {
        explicit Stopper(RTC::Manager* m) : DataFlowComponentBase(m) {}
        RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
            stopped = getOwnContexts().at(0)->stop();
            started = getOwnContexts().at(0)->start();
            ++cycles;
            return RTC::RTC_OK;
        }
        std::atomic<long> cycles{0};
        std::atomic<RTC::ReturnCode_t> stopped{RTC::RTC_ERROR}, started{RTC::RTC_ERROR};
    };
    ManagerFixture fixture(false);
    register_component_type<Stopper>(fixture.manager(), "Stopper");
    auto& one = fixture.create<Stopper>("Stopper?exec_cxt.periodic.rate=1000");
    CORBA_RTCUtil::activate(RTC::RTObject_var(one.getObjRef()).in());
    auto& context = context_of<RTC_exp::PeriodicExecutionContext>(one);
    for (long life = 1; life <= 3; ++life) {
        for (int i = 0; i < 10000 && one.cycles < life; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        CHECK(one.cycles == life);
        CHECK(context.start() == RTC::RTC_OK);
        CHECK(one.stopped == RTC::RTC_OK);
        CHECK(one.started == RTC::PRECONDITION_NOT_MET);
    }
}

TEST_CASE("Each tick of an externally triggered context is one cycle in the thread of the context") {
    ManagerFixture fixture(false);
    auto& one = ticker(fixture, "exec_cxt.periodic.type=ExtTrigExecutionContext");
    auto& context = context_of<RTC::ExtTrigExecutionContext>(one);
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    CHECK(fixture.state(one) == RTC::ACTIVE_STATE);
    CHECK(one.count() == 0);
    for (int i = 0; i < 100; ++i) context.tick();
    REQUIRE(reaches(one, 100));
    CHECK(one.deactivate(0) == RTC::RTC_OK);
    CHECK(one.count() == 100);
    CHECK(one.threads.size() == 1);
    CHECK(one.threads.count(std::this_thread::get_id()) == 0);
}

TEST_CASE("Each tick of a synchronously triggered context is one cycle in the thread of the caller") {
    const std::string type =
        GENERATE("SynchExtTriggerEC", "OpenHRPExecutionContext", "SimulatorExecutionContext");
    static ManagerFixture fixture(false);
    register_component_type<Ticker>(fixture.manager(), "Ticker");
    auto& one = fixture.create<Ticker>("Ticker?exec_cxt.periodic.type=" + type);
    RTC::ExecutionContext_var reference = one.get_context(0);
    auto context = OpenRTM::ExtTrigExecutionContextService::_narrow(reference.in());
    REQUIRE_FALSE(CORBA::is_nil(context));
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    for (int i = 1; i <= 100; ++i) {
        context_of<RTC::OpenHRPExecutionContext>(one).tick();
        REQUIRE(one.cycles == i);
    }
    CHECK(one.threads == std::set<std::thread::id>{std::this_thread::get_id()});
    CORBA::release(context);
}

TEST_CASE("A component has the contexts that execution_contexts lists, each with its own options") {
    ManagerFixture fixture(false);
    auto& one =
        ticker(fixture, "execution_contexts=PeriodicExecutionContext(fast), ExtTrigExecutionContext(hand)"
                        "&ec.fast.rate=250&ec.ExtTrigExecutionContext.sync_transition=NO");
    REQUIRE(one.getOwnContexts().size() == 2);
    CHECK(context_of<RTC_exp::PeriodicExecutionContext>(one, 0).getRate() == 250);
    CHECK(context_of<RTC::ExtTrigExecutionContext>(one, 1).getProperties().getProperty("name") == "hand");
    CHECK(one.activate(0) == RTC::RTC_OK);
    CHECK(one.activate(1) == RTC::RTC_OK);

    auto& none = fixture.create<Ticker>("Ticker?execution_contexts=None");
    CHECK(none.getOwnContexts().empty());
    CHECK_THROWS_WITH(fixture.create<Ticker>("Ticker?execution_contexts=NoSuchEC(x)"),
                      Catch::Contains("NoSuchEC"));
    CHECK_THROWS_WITH(fixture.create<Ticker>("Ticker?execution_contexts=NoSuchEC(x"),
                      Catch::Contains("type(name)"));
}

TEST_CASE("Without sync_transition a request returns before it is carried out") {
    struct Slow : Ticker {
        using Ticker::Ticker;
        RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
            opened.get_future().wait();
            return RTC::RTC_OK;
        }
        std::promise<void> opened;
    };
    ManagerFixture fixture(false);
    register_component_type<Slow>(fixture.manager(), "Slow");
    auto& one = fixture.create<Slow>("Slow?exec_cxt.periodic.rate=5&exec_cxt.sync_activation=NO");
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    CHECK(fixture.state(one) == RTC::INACTIVE_STATE);
    one.opened.set_value();
    REQUIRE(reaches(one, 1));
    CHECK(one.deactivate(0) == RTC::RTC_OK);
    CHECK(fixture.state(one) == RTC::INACTIVE_STATE);
}

namespace {

/// Its ticks are 1,000 s apart: what waits for one fails after a minute.
const std::string without_ticks = "exec_cxt.periodic.rate=0.001";

/// Records the threads of its callbacks.
struct Starter : Ticker {
    using Ticker::Ticker;
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return called(); }
    RTC::ReturnCode_t onExecute(RTC::UniqueId id) override {
        called();
        return Ticker::onExecute(id);
    }
    RTC::ReturnCode_t called() {
        callers.push_back(std::this_thread::get_id());
        return RTC::RTC_OK;
    }
    std::vector<std::thread::id> callers;
};

} // namespace

TEST_CASE("A context in which nothing is active has its first cycle without waiting for a tick") {
    ManagerFixture fixture(false);
    register_component_type<Starter>(fixture.manager(), "Starter");
    for (int i = 0; i < 10; ++i) {
        auto& one = fixture.create<Starter>("Starter?" + without_ticks);
        REQUIRE(one.activate(0) == RTC::RTC_OK);
        CHECK(fixture.state(one) == RTC::ACTIVE_STATE);
        REQUIRE(reaches(one, 1));
        REQUIRE(one.callers.size() == 2);
        CHECK(one.callers[0] == one.callers[1]);
        CHECK(one.callers[0] != std::this_thread::get_id());
        CHECK(context_of<RTC_exp::PeriodicExecutionContext>(one).tickStatistics().cycles == 0);
    }
}

TEST_CASE("Transitions of one component bring no cycle between the ticks of another one in its context") {
    ManagerFixture fixture(false);
    auto& one = ticker(fixture, "exec_cxt.periodic.rate=200");
    auto& other = ticker(fixture, "execution_contexts=None");
    auto& context = context_of<RTC_exp::PeriodicExecutionContext>(one);
    RTC::RTObject_var guest = other.getObjRef();
    REQUIRE(context.addComponent(guest.in()) == RTC::RTC_OK);
    REQUIRE(one.activate(0) == RTC::RTC_OK);
    for (int i = 0; i < 20; ++i) {
        REQUIRE(context.activateComponent(guest.in()) == RTC::RTC_OK);
        REQUIRE(context.deactivateComponent(guest.in()) == RTC::RTC_OK);
    }
    REQUIRE(one.deactivate(0) == RTC::RTC_OK);
    context.stopThread();
    const auto cycles = static_cast<long>(context.tickStatistics().cycles);
    CHECK(one.count() == cycles); // the first is not that of a tick, the last tick has deactivated it
    CHECK(one.count() >= 40);
    CHECK(other.count() >= 20);
}

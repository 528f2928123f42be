// SPDX-License-Identifier: Apache-2.0
// The order of callbacks, the states of the OMG RTC specification, and errors in callbacks.
#include "tests/host/process/published_notices.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <rtm/ExecutionContextBase.h>

using namespace testing;

TEST_CASE("Callbacks come in the order of OpenRTM-aist from creation to end") {
    {
        ManagerFixture fixture;
        auto& rtc = fixture.create<Recorder>("Recorder");
        CHECK(Recorder::take_calls() == "initialize startup");
        CHECK(fixture.activate(rtc) == RTC::RTC_OK);
        CHECK(Recorder::take_calls() == "activated");
        CHECK(fixture.activate(rtc) == RTC::PRECONDITION_NOT_MET);
        fixture.step(rtc);
        CHECK(Recorder::take_calls() == "execute update");
        CHECK(rtc.deactivate(0) == RTC::RTC_OK);
        fixture.step(rtc);
        CHECK(Recorder::take_calls() == "deactivated");
        rtc.activate(0);
        Recorder::take_calls();
    }
    CHECK(Recorder::take_calls() == "deactivated shutdown finalize");
}

TEST_CASE("A component that fails or throws goes to the error state, stays there, and can be reset") {
    const bool throws = GENERATE(false, true);
    static ManagerFixture fixture;
    static auto& rtc = fixture.create<Recorder>("Recorder");
    Recorder::throws_exception() = throws;
    Recorder::failing_callback() = "execute";
    fixture.activate(rtc);
    Recorder::take_calls();
    fixture.step(rtc);
    CHECK(Recorder::take_calls() == "execute");
    fixture.step(rtc);
    CHECK(Recorder::take_calls() == "deactivated aborting error");
    CHECK(fixture.state(rtc) == RTC::ERROR_STATE);
    const auto reasons = [] { return published_notices(tandem::process::NoticeKind::component); };
    REQUIRE(reasons().size() == 1);
    CHECK_THAT(reasons()[0], Catch::StartsWith(std::string(rtc.getInstanceName()) + ": onExecute " +
                                               (throws ? "threw" : "returned 1 (RTC_ERROR)")));
    fixture.step(rtc);
    CHECK(Recorder::take_calls() == "error");

    Recorder::failing_callback() = "reset";
    CHECK(rtc.reset(0) == RTC::RTC_ERROR);
    CHECK(fixture.state(rtc) == RTC::ERROR_STATE);
    Recorder::failing_callback() = "";
    CHECK(rtc.reset(0) == RTC::RTC_OK);
    CHECK(fixture.state(rtc) == RTC::INACTIVE_STATE);
    CHECK(reasons().empty());
}

namespace {

// Takes a component through activation, cycles, a change of rate, deactivation and reset. Returns the first letters
// of its states on the way.
std::string whole_life(ManagerFixture& fixture, Recorder& rtc) {
    std::string states;
    auto note = [&] { states += RTC::ExecutionContextBase::getStateString(fixture.state(rtc))[0]; };
    rtc.activate(0);
    note();
    for (int i = 0; i < 3; ++i) fixture.step(rtc);
    note();
    rtc.setExecutionRate(0, 500);
    rtc.deactivate(0);
    fixture.step(rtc);
    note();
    rtc.reset(0);
    note();
    return states;
}

} // namespace

TEST_CASE("An error in any callback leads to the state that the specification names") {
    struct Row {
        const char* callback;
        const char* states; // after activation, after three cycles, after deactivation, after reset
    };
    // onAborting, onError and onReset only run after another callback has failed.
    const Row row =
        GENERATE(Row{"startup", "AAII"}, Row{"activated", "EEEI"}, Row{"execute", "AEEI"},
                 Row{"update", "AEEI"}, Row{"deactivated", "AAII"}, Row{"rate", "AAII"},
                 Row{"execute aborting", "AEEI"}, Row{"execute error", "AEEI"}, Row{"execute reset", "AEEE"});
    const bool throws = GENERATE(false, true);
    static ManagerFixture fixture;
    CAPTURE(row.callback, throws);
    Recorder::throws_exception() = throws;
    Recorder::failing_callback() = row.callback;
    auto& rtc = fixture.create<Recorder>("Recorder");
    CHECK(whole_life(fixture, rtc) == row.states);
    Recorder::failing_callback() = "";
}

TEST_CASE("Errors in onFinalize and onShutdown do not keep a component from exiting") {
    const std::string callback = GENERATE("shutdown", "finalize");
    const bool throws = GENERATE(false, true);
    static ManagerFixture fixture;
    auto& rtc = fixture.create<Recorder>("Recorder");
    Recorder::throws_exception() = throws;
    Recorder::failing_callback() = callback;
    rtc.exit();
    fixture.manager().cleanupComponents();
    CHECK(fixture.manager().getComponents().empty());
    Recorder::failing_callback() = "";
}

TEST_CASE("A component that cannot be activated is in the error state when the call returns") {
    ManagerFixture fixture;
    auto& rtc = fixture.create<Recorder>("Recorder");
    Recorder::failing_callback() = "activated";
    CHECK(fixture.activate(rtc) == RTC::RTC_ERROR);
    CHECK(fixture.state(rtc) == RTC::ERROR_STATE);
    Recorder::failing_callback() = "";
}

TEST_CASE("A component whose onInitialize fails is not created") {
    ManagerFixture fixture;
    Recorder::failing_callback() = "initialize";
    CHECK_THROWS_WITH(fixture.create<Recorder>("Recorder"), Catch::Contains("onInitialize"));
    CHECK(fixture.manager().getComponent("Recorder0") == nullptr);
    CHECK(fixture.manager().createComponent("Recorder") == nullptr);
    Recorder::failing_callback() = "";
    CHECK(fixture.manager().createComponent("Recorder") != nullptr);
}

TEST_CASE(
    "A periodic context runs in a separate thread, and its transitions are done when the call returns") {
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:500"});
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in&buffer.length=1000");
    CHECK(counter.getExecutionRate(0) == 500);
    REQUIRE(accumulator.activate(0) == RTC::RTC_OK);
    REQUIRE(counter.activate(0) == RTC::RTC_OK);
    CHECK(fixture.state(counter) == RTC::ACTIVE_STATE);
    for (int i = 0; i < 10000 && accumulator.received_ < 50; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(accumulator.received_ >= 50);
    CHECK(counter.setExecutionRate(0, 1000) == RTC::RTC_OK);
    const long before = accumulator.received_;
    for (int i = 0; i < 10000 && accumulator.received_ < before + 50; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(accumulator.received_ >= before + 50);
    CHECK(counter.deactivate(0) == RTC::RTC_OK);
    CHECK(fixture.state(counter) == RTC::INACTIVE_STATE);
}

TEST_CASE("A component's contexts and its profile describe it to tools") {
    ManagerFixture fixture;
    auto& rtc = fixture.create<Counter>("Counter?instance_name=Alice&exec_cxt.periodic.rate=25");
    RTC::ComponentProfile_var profile = rtc.get_component_profile();
    CHECK(std::string(profile->instance_name) == "Alice");
    CHECK(std::string(profile->type_name) == "Counter");
    REQUIRE(profile->port_profiles.length() == 1);
    CHECK(std::string(profile->port_profiles[0].name) == "Alice.out");
    CHECK(NVUtil::toString(profile->port_profiles[0].properties, "dataport.data_type") ==
          "IDL:RTC/TimedLong:1.0");

    RTC::ExecutionContextList_var contexts = rtc.get_owned_contexts();
    REQUIRE(contexts->length() == 1);
    CHECK(contexts[0]->get_rate() == 25);
    CHECK(contexts[0]->is_running());
    CHECK(rtc.get_context_handle(contexts[0]) == 0);
    RTC::ExecutionContextService_var service = RTC::ExecutionContextService::_narrow(contexts[0]);
    RTC::ExecutionContextProfile_var context = service->get_profile();
    CHECK(context->owner->_is_equivalent(RTC::RTObject_var(rtc.getObjRef()).in()));
    CHECK_THROWS_WITH(fixture.create<Counter>("Counter?instance_name=Alice"),
                      Catch::Contains("already a component Alice"));
}

TEST_CASE("A component can take part in another's context") {
    ManagerFixture fixture;
    auto& owner = fixture.create<Recorder>("Recorder");
    auto& guest = fixture.create<Counter>("Counter");
    RTC::RTObject_var ref = guest.getObjRef();
    RTC::ExecutionContext_var context = owner.get_context(0);
    REQUIRE(context->add_component(ref.in()) == RTC::RTC_OK);
    CHECK(guest.get_context_handle(context.in()) == ECOTHER_OFFSET);
    REQUIRE(context->activate_component(ref.in()) == RTC::RTC_OK);
    fixture.step(owner);
    CHECK(guest.value_.data == 1);
    CHECK(context->remove_component(ref.in()) == RTC::PRECONDITION_NOT_MET);
    context->deactivate_component(ref.in());
    CHECK(context->remove_component(ref.in()) == RTC::RTC_OK);
    CHECK(guest.get_context_handle(context.in()) == -1);
}

TEST_CASE("A component that calls exit() from its own callback is deleted afterwards") {
    ManagerFixture fixture(false, {"manager.shutdown_on_nortcs:YES"});
    struct Leaver : RTC::DataFlowComponentBase {
        explicit Leaver(RTC::Manager* m) : DataFlowComponentBase(m) {}
        RTC::ReturnCode_t onExecute(RTC::UniqueId) override { return exit(); }
    };
    register_component_type<Leaver>(fixture.manager(), "Leaver");
    fixture.create<Leaver>("Leaver").activate(0);
    fixture.manager().runManager(); // returns because the last component has exited
    CHECK(fixture.manager().getComponents().empty());
}

TEST_CASE(
    "A component that ends deactivates the others in its context, and they no longer list the context") {
    ManagerFixture fixture;
    auto& owner = fixture.create<Counter>("Counter");
    auto& guest = fixture.create<Recorder>("Recorder");
    auto& broken = fixture.create<Recorder>("Recorder");
    RTC::ExecutionContext_var context = owner.get_context(0);
    const RTC::RTObject_var guest_reference = guest.getObjRef(), broken_reference = broken.getObjRef();
    REQUIRE(context->add_component(guest_reference.in()) == RTC::RTC_OK);
    REQUIRE(context->add_component(broken_reference.in()) == RTC::RTC_OK);
    Recorder::failing_callback() = "activated";
    context->activate_component(broken_reference.in());
    Recorder::failing_callback() = "";
    REQUIRE(context->activate_component(guest_reference.in()) == RTC::RTC_OK);
    Recorder::take_calls();

    CHECK(owner.exit() == RTC::RTC_OK);
    const std::string calls = Recorder::take_calls();
    CHECK_THAT(calls, Catch::Contains("deactivated"));
    CHECK(calls.find("deactivated") < calls.find("shutdown"));
    for (auto* component : {&guest, &broken}) {
        RTC::ExecutionContextList_var others = component->get_participating_contexts();
        CHECK(others->length() == 0);
        CHECK_FALSE(component->is_alive(context.in()));
    }
    fixture.manager().cleanupComponents();
    CHECK(fixture.activate(guest) == RTC::RTC_OK); // in its own context
}

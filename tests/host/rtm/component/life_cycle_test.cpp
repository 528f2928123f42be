// SPDX-License-Identifier: Apache-2.0
#include "tests/host/rtm/fixture.hpp"
#include <rtm/ExecutionContextBase.h>

using namespace testing;

TEST_CASE("Callbacks come in RTM's order through a whole life") {
    {
        Stage stage;
        auto& rtc = stage.create<Recorder>("Recorder");
        CHECK(Recorder::story() == "initialize startup");
        CHECK(stage.activate(rtc) == RTC::RTC_OK);
        CHECK(Recorder::story() == "activated");
        CHECK(stage.activate(rtc) == RTC::PRECONDITION_NOT_MET);
        stage.step(rtc);
        CHECK(Recorder::story() == "execute update");
        CHECK(rtc.deactivate(0) == RTC::RTC_OK);
        stage.step(rtc);
        CHECK(Recorder::story() == "deactivated");
        rtc.activate(0);
        Recorder::story();
    }
    CHECK(Recorder::story() == "deactivated shutdown finalize");
}

TEST_CASE("A component that fails or throws goes to the error state, stays there, and can be reset") {
    const bool throws = GENERATE(false, true);
    static Stage stage;
    static auto& rtc = stage.create<Recorder>("Recorder");
    Recorder::throws() = throws;
    Recorder::trouble_in() = "execute";
    stage.activate(rtc);
    Recorder::story();
    stage.step(rtc);
    CHECK(Recorder::story() == "execute");
    stage.step(rtc);
    CHECK(Recorder::story() == "deactivated aborting error");
    CHECK(stage.state(rtc) == RTC::ERROR_STATE);
    stage.step(rtc);
    CHECK(Recorder::story() == "error");

    Recorder::trouble_in() = "reset";
    CHECK(rtc.reset(0) == RTC::RTC_ERROR);
    CHECK(stage.state(rtc) == RTC::ERROR_STATE);
    Recorder::trouble_in() = "";
    CHECK(rtc.reset(0) == RTC::RTC_OK);
    CHECK(stage.state(rtc) == RTC::INACTIVE_STATE);
}

namespace {

// Drives a component through everything there is, and says in which states it was.
std::string whole_life(Stage& stage, Recorder& rtc) {
    std::string states;
    auto note = [&] { states += RTC::ExecutionContextBase::getStateString(stage.state(rtc))[0]; };
    rtc.activate(0);
    note();
    for (int i = 0; i < 3; ++i) stage.step(rtc);
    note();
    rtc.setExecutionRate(0, 500);
    rtc.deactivate(0);
    stage.step(rtc);
    note();
    rtc.reset(0);
    note();
    return states;
}

} // namespace

TEST_CASE("Trouble in any callback leads where RTM says and nowhere else") {
    struct Row {
        const char* callback;
        const char* states; // when activated, after three cycles, when deactivated, when reset
    };
    // A second callback follows to get to onAborting, onError and onReset.
    const Row row =
        GENERATE(Row{"startup", "AAII"}, Row{"activated", "EEEI"}, Row{"execute", "AEEI"},
                 Row{"update", "AEEI"}, Row{"deactivated", "AAII"}, Row{"rate", "AAII"},
                 Row{"execute aborting", "AEEI"}, Row{"execute error", "AEEI"}, Row{"execute reset", "AEEE"});
    const bool throws = GENERATE(false, true);
    static Stage stage;
    CAPTURE(row.callback, throws);
    Recorder::throws() = throws;
    Recorder::trouble_in() = row.callback;
    auto& rtc = stage.create<Recorder>("Recorder");
    CHECK(whole_life(stage, rtc) == row.states);
    Recorder::trouble_in() = "";
}

TEST_CASE("Trouble in onFinalize and onShutdown does not keep a component from leaving") {
    const std::string callback = GENERATE("shutdown", "finalize");
    const bool throws = GENERATE(false, true);
    static Stage stage;
    auto& rtc = stage.create<Recorder>("Recorder");
    Recorder::throws() = throws;
    Recorder::trouble_in() = callback;
    rtc.exit();
    stage.manager().cleanupComponents();
    CHECK(stage.manager().getComponents().empty());
    Recorder::trouble_in() = "";
}

TEST_CASE("A component that cannot be activated is in the error state when the call returns") {
    Stage stage;
    auto& rtc = stage.create<Recorder>("Recorder");
    Recorder::trouble_in() = "activated";
    CHECK(stage.activate(rtc) == RTC::RTC_ERROR);
    CHECK(stage.state(rtc) == RTC::ERROR_STATE);
    Recorder::trouble_in() = "";
}

TEST_CASE("A component whose onInitialize fails is not there") {
    Stage stage;
    Recorder::trouble_in() = "initialize";
    CHECK_THROWS_WITH(stage.create<Recorder>("Recorder"), Catch::Contains("onInitialize"));
    CHECK(stage.manager().getComponent("Recorder0") == nullptr);
    CHECK(stage.manager().createComponent("Recorder") == nullptr);
    Recorder::trouble_in() = "";
    CHECK(stage.manager().createComponent("Recorder") != nullptr);
}

TEST_CASE(
    "A periodic context runs in a thread of its own, and its transitions are done when the call returns") {
    Stage stage(false, {"exec_cxt.periodic.rate:500"});
    auto& counter = stage.create<Counter>("Counter");
    auto& summer = stage.create<Summer>("Summer");
    stage.connect("Counter0.out?port=Summer0.in&buffer.length=1000");
    CHECK(counter.getExecutionRate(0) == 500);
    REQUIRE(summer.activate(0) == RTC::RTC_OK);
    REQUIRE(counter.activate(0) == RTC::RTC_OK);
    CHECK(stage.state(counter) == RTC::ACTIVE_STATE);
    for (int i = 0; i < 10000 && summer.received_ < 50; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(summer.received_ >= 50);
    CHECK(counter.setExecutionRate(0, 1000) == RTC::RTC_OK);
    const long before = summer.received_;
    for (int i = 0; i < 10000 && summer.received_ < before + 50; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(summer.received_ >= before + 50);
    CHECK(counter.deactivate(0) == RTC::RTC_OK);
    CHECK(stage.state(counter) == RTC::INACTIVE_STATE);
}

TEST_CASE("Contexts are found through the component, and the profile says what it is") {
    Stage stage;
    auto& rtc = stage.create<Counter>("Counter?instance_name=Alice&exec_cxt.periodic.rate=25");
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
    CHECK_THROWS_WITH(stage.create<Counter>("Counter?instance_name=Alice"),
                      Catch::Contains("already a component Alice"));
}

TEST_CASE("A component can take part in another's context") {
    Stage stage;
    auto& owner = stage.create<Recorder>("Recorder");
    auto& guest = stage.create<Counter>("Counter");
    RTC::RTObject_var ref = guest.getObjRef();
    RTC::ExecutionContext_var context = owner.get_context(0);
    REQUIRE(context->add_component(ref.in()) == RTC::RTC_OK);
    CHECK(guest.get_context_handle(context.in()) == ECOTHER_OFFSET);
    REQUIRE(context->activate_component(ref.in()) == RTC::RTC_OK);
    stage.step(owner);
    CHECK(guest.value_.data == 1);
    CHECK(context->remove_component(ref.in()) == RTC::PRECONDITION_NOT_MET);
    context->deactivate_component(ref.in());
    CHECK(context->remove_component(ref.in()) == RTC::RTC_OK);
    CHECK(guest.get_context_handle(context.in()) == -1);
}

TEST_CASE("A component that calls exit() from its own callback is gone afterwards") {
    Stage stage(false, {"manager.shutdown_on_nortcs:YES"});
    struct Leaver : RTC::DataFlowComponentBase {
        explicit Leaver(RTC::Manager* m) : DataFlowComponentBase(m) {}
        RTC::ReturnCode_t onExecute(RTC::UniqueId) override { return exit(); }
    };
    register_as<Leaver>(stage.manager(), "Leaver");
    stage.create<Leaver>("Leaver").activate(0);
    stage.manager().runManager(); // leaves because its last component has
    CHECK(stage.manager().getComponents().empty());
}

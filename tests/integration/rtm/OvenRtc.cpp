// SPDX-License-Identifier: Apache-2.0
// An oven whose state machine takes events through the port `panel`, and prints what it does.
#include "register_rtc.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/EventPort.h>
#include <rtm/StaticFSM.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <iostream>
#include <string>
#include <syncstream>

namespace oven {

void say(const std::string& text) { std::osyncstream(std::cout) << "oven: " + text + "\n" << std::flush; }

FSM_TOPSTATE(Top) {
    struct Box {
        int minutes = 0;
    };
    FSM_STATE(Top);
    virtual void minutes(RTC::TimedLong) {}
    virtual void start() {}
    virtual void tick() {}
    virtual void label(RTC::TimedString text) { say("label " + std::string(text.data.in())); }
    virtual void turn(RTC::TimedLong) {}

  private:
    RTC::ReturnCode_t onInit() override;
};

FSM_SUBSTATE(Idle, Top) {
    FSM_STATE(Idle);
    void minutes(RTC::TimedLong time) override {
        TOP::box().minutes = time.data;
        say(std::to_string(time.data) + " minutes" + (time.tm.sec ? ", a time" : ""));
    }
    void start() override;
    RTC::ReturnCode_t onEntry() override {
        TOP::box().minutes = 0;
        say("idle");
        return RTC::RTC_OK;
    }
};

FSM_SUBSTATE(Heating, Top) {
    FSM_STATE(Heating);
    void tick() override {
        say("tick");
        if (--TOP::box().minutes == 0) setState<Idle>();
    }
    RTC::ReturnCode_t onEntry() override {
        say("heating");
        return RTC::RTC_OK;
    }
};

RTC::ReturnCode_t Top::onInit() {
    setState<Idle>();
    return RTC::RTC_OK;
}
void Idle::start() {
    if (TOP::box().minutes > 0) setState<Heating>();
}

} // namespace oven

FSM_INIT_VALUE(oven::Top)

class OvenRtc : public RTC::DataFlowComponentBase {
  public:
    using Machine = RTC::Machine<oven::Top>;
    explicit OvenRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), fsm_(this), panel_("panel", fsm_), knob_("knob", fsm_) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("panel", panel_);
        panel_.bindEvent("minutes", &oven::Top::minutes);
        panel_.bindEvent("start", &oven::Top::start);
        panel_.bindEvent("tick", &oven::Top::tick);
        panel_.bindEvent("label", &oven::Top::label);
        addInPort("knob", knob_);
        knob_.bindEvent("turn", &oven::Top::turn);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        fsm_.run_event();
        return RTC::RTC_OK;
    }

  private:
    Machine fsm_;
    RTC::EventInPort<Machine> panel_, knob_;
};

extern "C" void OvenRtcInit(RTC::Manager* manager) { register_rtc<OvenRtc>(manager, "OvenRtc"); }

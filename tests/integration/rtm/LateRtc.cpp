// SPDX-License-Identifier: Apache-2.0
// Adds a port when it is activated, and adds and removes others as its configuration parameter `stage` says, in the thread
// that sets it: `add` those of whole numbers, `double` those of doubles by the same names, which its parameter `late` asks for
// from the start. Sends numbered messages, and prints which messages it receives and which numbers are missing.
#include "register_rtc.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <functional>
#include <iostream>
#include <string>
#include <syncstream>

namespace {

class StageListener final : public RTC::ConfigurationSetListener {
  public:
    explicit StageListener(std::function<void(const std::string&)> enter) : enter_(std::move(enter)) {}
    void operator()(const coil::Properties& set) override { enter_(set.getProperty("stage")); }

  private:
    const std::function<void(const std::string&)> enter_;
};

} // namespace

class LateRtc : public RTC::DataFlowComponentBase {
  public:
    explicit LateRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), steadyOut_("steady", number_), backIn_("back", back_),
          activatedOut_("activated", number_), lateOut_("late", number_), doubleOut_("late", half_),
          lateIn_("lateIn", late_), doubleIn_("lateIn", double_) {}

    RTC::ReturnCode_t onInitialize() override {
        addOutPort("steady", steadyOut_);
        addInPort("back", backIn_);
        bindParameter("stage", stage_, "none");
        addConfigurationSetListener(RTC::ON_SET_CONFIG_SET,
                                    new StageListener([this](const std::string& stage) { enter(stage); }));
        enter(getProperties().getProperty("late"));
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        addOutPort("activated", activatedOut_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        ++number_.data;
        steadyOut_.write();
        activatedOut_.write();
        lateOut_.write();
        half_.data = number_.data + 0.5;
        doubleOut_.write();
        while (backIn_.isNew()) {
            backIn_.read();
            if (last_back_ != 0 && back_.data != last_back_ + 1) say("back lacks a number");
            last_back_ = back_.data;
        }
        while (lateIn_.isNew()) {
            lateIn_.read();
            say("lateIn " + std::to_string(late_.data));
        }
        while (doubleIn_.isNew()) {
            doubleIn_.read();
            say("lateIn double " + std::to_string(double_.data));
        }
        return RTC::RTC_OK;
    }

  private:
    void enter(const std::string& stage) {
        if (stage == stage_now_ || stage.empty()) return;
        if (stage_now_ == "add") {
            removeOutPort(lateOut_);
            removeInPort(lateIn_);
        } else if (stage_now_ == "double") {
            removeOutPort(doubleOut_);
            removeInPort(doubleIn_);
        }
        if (stage == "add") {
            addOutPort("late", lateOut_);
            addInPort("lateIn", lateIn_);
        } else if (stage == "double") {
            addOutPort("late", doubleOut_);
            addInPort("lateIn", doubleIn_);
        }
        stage_now_ = stage;
    }
    static void say(const std::string& what) {
        std::osyncstream(std::cout) << "LateRtc " + what << std::endl;
    }

    std::string stage_, stage_now_;
    RTC::TimedDouble half_{}, double_{};
    RTC::TimedLong number_{}, back_{}, late_{};
    CORBA::Long last_back_ = 0;
    RTC::OutPort<RTC::TimedLong> steadyOut_;
    RTC::InPort<RTC::TimedLong> backIn_;
    RTC::OutPort<RTC::TimedLong> activatedOut_, lateOut_;
    RTC::OutPort<RTC::TimedDouble> doubleOut_;
    RTC::InPort<RTC::TimedLong> lateIn_;
    RTC::InPort<RTC::TimedDouble> doubleIn_;
};

extern "C" void LateRtcInit(RTC::Manager* manager) { register_rtc<LateRtc>(manager, "LateRtc"); }

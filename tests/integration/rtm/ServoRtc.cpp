// SPDX-License-Identifier: Apache-2.0
// Sends a number in each cycle; its parameter `fails` makes that fail.
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

class ServoRtc : public RTC::DataFlowComponentBase {
  public:
    explicit ServoRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), in_("in", received_), out_("out", sent_) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("in", in_);
        addOutPort("out", out_);
        bindParameter("gain", gain_, "1");
        bindParameter("fails", fails_, "0");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (in_.isNew()) in_.read();
        sent_.data = gain_;
        out_.write();
        return fails_ != 0 ? RTC::RTC_ERROR : RTC::RTC_OK;
    }
    RTC::ReturnCode_t onReset(RTC::UniqueId) override {
        fails_ = 0;
        return RTC::RTC_OK;
    }

  private:
    double gain_ = 1;
    int fails_ = 0;
    RTC::TimedDouble received_{}, sent_{};
    RTC::InPort<RTC::TimedDouble> in_;
    RTC::OutPort<RTC::TimedDouble> out_;
};

extern "C" void ServoRtcInit(RTC::Manager* manager) { register_rtc<ServoRtc>(manager, "ServoRtc"); }

// SPDX-License-Identifier: Apache-2.0
// Sends the number of its cycle; removes its port, adds another one, and later the first one again.
#include "register_rtc.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

class ShiftRtc : public RTC::DataFlowComponentBase {
  public:
    explicit ShiftRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), numberOut_("number", number_), extraIn_("extra", extra_) {}

    RTC::ReturnCode_t onInitialize() override {
        addOutPort("number", numberOut_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        ++cycle_;
        if (cycle_ == 50) removeOutPort(numberOut_);
        if (cycle_ == 60) addInPort("extra", extraIn_);
        if (cycle_ == 70) addOutPort("number", numberOut_);
        number_.data = cycle_;
        numberOut_.write();
        return RTC::RTC_OK;
    }

  private:
    int cycle_ = 0;
    RTC::TimedDouble number_{}, extra_{};
    RTC::OutPort<RTC::TimedDouble> numberOut_;
    RTC::InPort<RTC::TimedDouble> extraIn_;
};

extern "C" void ShiftRtcInit(RTC::Manager* manager) { register_rtc<ShiftRtc>(manager, "ShiftRtc"); }

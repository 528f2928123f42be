// SPDX-License-Identifier: Apache-2.0
// Sends the twenty numbers around the largest 16-bit number, one in each cycle, and prints what it receives.
#include "register_rtc.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <iostream>
#include <string>
#include <syncstream>

class RangeRtc : public RTC::DataFlowComponentBase {
  public:
    explicit RangeRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), numberOut_("number", number_), smallIn_("small", small_) {}

    RTC::ReturnCode_t onInitialize() override {
        addOutPort("number", numberOut_);
        addInPort("small", smallIn_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (number_.data < 32777) {
            ++number_.data;
            numberOut_.write();
        }
        while (smallIn_.isNew()) {
            smallIn_.read();
            std::osyncstream(std::cout) << "RangeRtc small " << small_.data << std::endl;
        }
        return RTC::RTC_OK;
    }

  private:
    RTC::TimedLong number_{{}, 32757};
    RTC::TimedShort small_{};
    RTC::OutPort<RTC::TimedLong> numberOut_;
    RTC::InPort<RTC::TimedShort> smallIn_;
};

extern "C" void RangeRtcInit(RTC::Manager* manager) { register_rtc<RangeRtc>(manager, "RangeRtc"); }

// SPDX-License-Identifier: Apache-2.0
// Reads the keyboard in onExecute, as its property `how` says.
#include "tests/integration/rtm/register_rtc.hpp"
#include "tests/integration/terminal/read_keys.hpp"

#include <rtm/DataFlowComponentBase.h>

class KeyRtc : public RTC::DataFlowComponentBase {
  public:
    explicit KeyRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        read_keys(getProperties().getProperty("how"));
        return RTC::RTC_OK;
    }
};

extern "C" void KeyRtcInit(RTC::Manager* manager) { register_rtc<KeyRtc>(manager, "KeyRtc"); }

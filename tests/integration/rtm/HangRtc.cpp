// SPDX-License-Identifier: Apache-2.0
// The callback that its property `in` names does not return until the file that its property `until` names
// exists.
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <string>
#include <syncstream>
#include <thread>

class HangRtc : public RTC::DataFlowComponentBase {
  public:
    explicit HangRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return say("activated"); }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        say("deactivating");
        hang("onDeactivated");
        return say("deactivated");
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        hang("onExecute");
        return RTC::RTC_OK;
    }

  private:
    void hang(const std::string& callback) {
        if (getProperties().getProperty("in") != callback) return;
        const std::filesystem::path end = getProperties().getProperty("until");
        for (int i = 0; i < 30'000 && !end.empty() && !std::filesystem::exists(end); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    RTC::ReturnCode_t say(const std::string& what) {
        std::osyncstream(std::cout) << getInstanceName() << " " << what << std::endl;
        return RTC::RTC_OK;
    }
};

extern "C" void HangRtcInit(RTC::Manager* manager) { register_rtc<HangRtc>(manager, "HangRtc"); }

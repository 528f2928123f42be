// SPDX-License-Identifier: Apache-2.0
// Prints 100 KB to standard output in each cycle, and creates the file `printed` in its folder after 200 cycles.
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

#include <fstream>
#include <iostream>
#include <string>

class PrinterRtc : public RTC::DataFlowComponentBase {
  public:
    explicit PrinterRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        const std::string line(999, 'x');
        for (int i = 0; i < 100; ++i) std::cout << line << "\n";
        std::cout.flush();
        if (++cycles_ == 200) std::ofstream("printed") << "done";
        return RTC::RTC_OK;
    }

  private:
    int cycles_ = 0;
};

extern "C" void PrinterRtcInit(RTC::Manager* manager) { register_rtc<PrinterRtc>(manager, "PrinterRtc"); }

// SPDX-License-Identifier: Apache-2.0
// Eight InPorts, in0 to in7, whose values go out through out0 to out7.
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <memory>
#include <string>
#include <vector>

class PortsRtc : public RTC::DataFlowComponentBase {
  public:
    explicit PortsRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        for (int i = 0; i < 8; ++i) {
            pairs_.push_back(std::make_unique<Pair>(std::to_string(i)));
            addInPort(pairs_.back()->in.name(), pairs_.back()->in);
            addOutPort(pairs_.back()->out.name(), pairs_.back()->out);
        }
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        for (auto& pair : pairs_)
            while (pair->in.isNew()) {
                pair->in.read();
                pair->out.write();
            }
        return RTC::RTC_OK;
    }

  private:
    struct Pair {
        explicit Pair(const std::string& number)
            : in(("in" + number).c_str(), value), out(("out" + number).c_str(), value) {}
        RTC::TimedDoubleSeq value;
        RTC::InPort<RTC::TimedDoubleSeq> in;
        RTC::OutPort<RTC::TimedDoubleSeq> out;
    };
    std::vector<std::unique_ptr<Pair>> pairs_;
};

extern "C" void PortsRtcInit(RTC::Manager* manager) { register_rtc<PortsRtc>(manager, "PortsRtc"); }

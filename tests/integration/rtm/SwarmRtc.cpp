// SPDX-License-Identifier: Apache-2.0
// Sends back what it gets, with the number of its instance in front.
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

class SwarmRtc : public RTC::DataFlowComponentBase {
  public:
    explicit SwarmRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("in", in_);
        addOutPort("out", out_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (in_.isNew() && in_.read()) {
            sent_.data.length(3);
            sent_.data[0] = getInstanceName()[sizeof "SwarmRtc" - 1] - '0';
            for (CORBA::ULong i = 0; i < 2; ++i) sent_.data[i + 1] = received_.data[i];
            out_.write();
        }
        return RTC::RTC_OK;
    }

  private:
    RTC::TimedLongSeq received_{}, sent_{};
    RTC::InPort<RTC::TimedLongSeq> in_{"in", received_};
    RTC::OutPort<RTC::TimedLongSeq> out_{"out", sent_};
};

extern "C" void SwarmRtcInit(RTC::Manager* manager) { register_rtc<SwarmRtc>(manager, "SwarmRtc"); }

// SPDX-License-Identifier: Apache-2.0
// Multiplies numbers by a gain and passes them on. The first of a chain counts.
#include "tests/integration/rtm/register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

class PartRtc : public RTC::DataFlowComponentBase {
  public:
    explicit PartRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), in_("in", received_), out_("out", sent_) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("in", in_);
        addOutPort("out", out_);
        bindParameter("gain", gain_, "1");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (in_.isNew()) {
            in_.read();
            sent_ = received_;
            for (CORBA::ULong i = 0; i < sent_.data.length(); ++i) sent_.data[i] *= gain_;
            out_.write();
        }
        return RTC::RTC_OK;
    }

  private:
    double gain_ = 1;
    RTC::TimedDoubleSeq received_, sent_;
    RTC::InPort<RTC::TimedDoubleSeq> in_;
    RTC::OutPort<RTC::TimedDoubleSeq> out_;
};

extern "C" void PartRtcInit(RTC::Manager* manager) { register_rtc<PartRtc>(manager, "PartRtc"); }

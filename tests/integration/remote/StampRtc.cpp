// SPDX-License-Identifier: Apache-2.0
// Receives each time in a listener, and sends its own time from there.
#include "tests/integration/remote/stamps.hpp"
#include "tests/integration/rtm/register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <iostream>
#include <syncstream>

class StampRtc : public RTC::DataFlowComponentBase {
  public:
    explicit StampRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), there_("there", received_), back_("back", sent_) {}

    RTC::ReturnCode_t onInitialize() override {
        there_.addConnectorDataListener(RTC::ON_RECEIVED, new Listener(*this));
        addInPort("there", there_);
        addOutPort("back", back_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (there_.isNew()) there_.read();
        return RTC::RTC_OK;
    }

  private:
    class Listener : public RTC::ConnectorDataListenerT<RTC::TimedDoubleSeq> {
      public:
        USE_CONNLISTENER_STATUS;
        explicit Listener(StampRtc& rtc) : rtc_(rtc) {}
        ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedDoubleSeq& message) override {
            rtc_.answer(message);
            return NO_CHANGE;
        }

      private:
        StampRtc& rtc_;
    };
    void answer(const RTC::TimedDoubleSeq& message) {
        if (message.data.length() != 3) return;
        const bool last = stamps_.take(message.data[0], message.data[1], message.data[2]);
        sent_ = message;
        sent_.data[1] = Stamps::now();
        back_.write();
        if (last) std::osyncstream(std::cout) << "there: " << stamps_.text() << std::endl;
    }

    Stamps stamps_;
    RTC::TimedDoubleSeq received_, sent_;
    RTC::InPort<RTC::TimedDoubleSeq> there_;
    RTC::OutPort<RTC::TimedDoubleSeq> back_;
};

extern "C" void StampRtcInit(RTC::Manager* manager) { register_rtc<StampRtc>(manager, "StampRtc"); }

// SPDX-License-Identifier: Apache-2.0
// Answers each alarm with one of twice the level.
#include "AlarmSkel.h"
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <string>

class AlarmRtc : public RTC::DataFlowComponentBase {
  public:
    explicit AlarmRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), raisedIn_("raised", raised_), answerOut_("answer", answer_) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("raised", raisedIn_);
        addOutPort("answer", answerOut_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (raisedIn_.isNew()) {
            raisedIn_.read();
            answer_.tm = raised_.tm;
            answer_.id = CORBA::string_dup(
                (std::string("answer to ") + raised_.id.in() + (raised_.tm.sec ? " at a time" : "")).c_str());
            answer_.level = 2 * raised_.level;
            answerOut_.write();
        }
        return RTC::RTC_OK;
    }

  private:
    TestAlarm::TimedAlarm raised_, answer_;
    RTC::InPort<TestAlarm::TimedAlarm> raisedIn_;
    RTC::OutPort<TestAlarm::TimedAlarm> answerOut_;
};

extern "C" void AlarmRtcInit(RTC::Manager* manager) { register_rtc<AlarmRtc>(manager, "AlarmRtc"); }

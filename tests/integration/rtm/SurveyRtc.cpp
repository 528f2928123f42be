// SPDX-License-Identifier: Apache-2.0
// Sends back a user's own structures, changed in each member.
#include "SurveySkel.h"
#include "register_rtc.hpp"

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

namespace {

void change(TestSurvey::Mark& mark) {
    mark.x += 1;
    mark.y *= 2;
    mark.label = (std::string(mark.label) + "!").c_str();
}

class SurveyService : public POA_TestSurvey::Surveyor, public virtual PortableServer::RefCountServantBase {
  public:
    TestSurvey::MarkList* move(const TestSurvey::MarkList& from, double dx) override {
        auto* moved = new TestSurvey::MarkList(from);
        for (CORBA::ULong i = 0; i < moved->length(); ++i) (*moved)[i].x += dx;
        return moved;
    }
};

} // namespace

class SurveyRtc : public RTC::DataFlowComponentBase {
  public:
    explicit SurveyRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), markIn_("mark", mark_), markOut_("markBack", mark_),
          scanIn_("scan", scan_), scanOut_("scanBack", scan_), readingIn_("reading", reading_),
          readingOut_("readingBack", reading_), surveyorPort_("surveyor") {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("mark", markIn_);
        addOutPort("markBack", markOut_);
        addInPort("scan", scanIn_);
        addOutPort("scanBack", scanOut_);
        addInPort("reading", readingIn_);
        addOutPort("readingBack", readingOut_);
        surveyorPort_.registerProvider("surveyor", "TestSurvey::Surveyor", surveyor_);
        addPort(surveyorPort_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (markIn_.isNew()) {
            markIn_.read();
            change(mark_.data);
            markOut_.write();
        }
        while (scanIn_.isNew()) {
            scanIn_.read();
            scan_.id += 1;
            for (CORBA::ULong i = 0; i < scan_.marks.length(); ++i) change(scan_.marks[i]);
            scan_.valid = !scan_.valid;
            scanOut_.write();
        }
        while (readingIn_.isNew()) {
            readingIn_.read();
            reading_.channel += 1;
            const CORBA::ULong count = reading_.values.length();
            reading_.values.length(count + 1);
            reading_.values[count] = 0.5;
            readingOut_.write();
        }
        return RTC::RTC_OK;
    }

  private:
    TestSurvey::TimedMark mark_;
    TestSurvey::TimedScan scan_;
    TestSurvey::Reading reading_;
    RTC::InPort<TestSurvey::TimedMark> markIn_;
    RTC::OutPort<TestSurvey::TimedMark> markOut_;
    RTC::InPort<TestSurvey::TimedScan> scanIn_;
    RTC::OutPort<TestSurvey::TimedScan> scanOut_;
    RTC::InPort<TestSurvey::Reading> readingIn_;
    RTC::OutPort<TestSurvey::Reading> readingOut_;
    RTC::CorbaPort surveyorPort_;
    SurveyService surveyor_;
};

extern "C" void SurveyRtcInit(RTC::Manager* manager) { register_rtc<SurveyRtc>(manager, "SurveyRtc"); }

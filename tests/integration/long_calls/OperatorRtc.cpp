// SPDX-License-Identifier: Apache-2.0
// Uses a crane.
#include "CraneStub.h"
#include "operator.h"
#include "tests/integration/rtm/register_rtc.hpp"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>

class OperatorRtc : public RTC::DataFlowComponentBase {
  public:
    explicit OperatorRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager), port_("crane") {}

    RTC::ReturnCode_t onInitialize() override {
        bindParameter("pipe", pipe_, "");
        port_.registerConsumer("crane", "TestCrane::Crane", crane_);
        addPort(port_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        operator_.start(pipe_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        operator_.stop();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onFinalize() override {
        operator_.stop();
        return RTC::RTC_OK;
    }

  private:
    std::string lift(int steps) {
        try {
            return std::to_string(crane_->lift(steps));
        } catch (const CORBA::SystemException& error) {
            return error._rep_id();
        }
    }
    void lower(int steps) {
        try {
            crane_->lower(steps);
        } catch (const CORBA::SystemException& error) {
            say(std::string("operator: lower failed: ") + error._name());
        }
    }
    std::string pipe_;
    RTC::CorbaPort port_;
    RTC::CorbaConsumer<TestCrane::Crane> crane_;
    Operator operator_{[this](int steps) { return lift(steps); }, [this](int steps) { lower(steps); }};
};

extern "C" void OperatorRtcInit(RTC::Manager* manager) { register_rtc<OperatorRtc>(manager, "OperatorRtc"); }

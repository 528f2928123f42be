// SPDX-License-Identifier: Apache-2.0
// Provides a crane.
#include "CraneSkel.h"
#include "crane.h"
#include "tests/integration/rtm/register_rtc.hpp"

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>

namespace {

class CraneService : public POA_TestCrane::Crane, public virtual PortableServer::RefCountServantBase {
  public:
    CORBA::Long lift(CORBA::Long steps) override { return work("lift", steps); }
    void lower(CORBA::Long steps) override { work("lower", steps); }
};

} // namespace

class CraneRtc : public RTC::DataFlowComponentBase {
  public:
    explicit CraneRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager), port_("crane") {}
    RTC::ReturnCode_t onInitialize() override {
        port_.registerProvider("crane", "TestCrane::Crane", crane_);
        addPort(port_);
        return RTC::RTC_OK;
    }

  private:
    CraneService crane_;
    RTC::CorbaPort port_;
};

extern "C" void CraneRtcInit(RTC::Manager* manager) { register_rtc<CraneRtc>(manager, "CraneRtc"); }

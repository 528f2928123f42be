// SPDX-License-Identifier: Apache-2.0
// An RTC that measures the level of a tank, until its configuration parameter `fault` names a fault.
#include "tank_faults.hpp"

#include <rtm/CorbaNaming.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

static const char* const tank_spec[] = {"implementation_id",
                                        "TankRtc",
                                        "type_name",
                                        "TankRtc",
                                        "description",
                                        "level of a tank",
                                        "version",
                                        "1.0.0",
                                        "vendor",
                                        "tests",
                                        "category",
                                        "test",
                                        "activity_type",
                                        "PERIODIC",
                                        "kind",
                                        "DataFlowComponent",
                                        "max_instance",
                                        "0",
                                        "language",
                                        "C++",
                                        "lang_type",
                                        "compile",
                                        "conf.default.fault",
                                        "",
                                        ""};

class TankRtc : public RTC::DataFlowComponentBase {
  public:
    explicit TankRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}
    RTC::ReturnCode_t onInitialize() override {
        bindParameter("fault", m_fault, "");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId ec_id) override {
        have_fault(m_fault);
        if (m_fault == "deactivates itself") getExecutionContext(ec_id)->deactivate_component(getObjRef());
        return RTC::RTC_OK;
    }

  private:
    std::string m_fault;
};

extern "C" void TankRtcInit(RTC::Manager* manager) {
    coil::Properties profile(tank_spec);
    manager->registerFactory(profile, RTC::Create<TankRtc>, RTC::Delete<TankRtc>);
}

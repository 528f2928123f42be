// SPDX-License-Identifier: Apache-2.0
// Only a callback that does not happen calls the undefined function.
#include "tests/host/plugin/zoo/rtc.hpp"
extern int nobody_defines_this();
namespace {
class Incomplete : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onReset(RTC::UniqueId) override {
        return nobody_defines_this() == 0 ? RTC::RTC_OK : RTC::RTC_ERROR;
    }
};
} // namespace
extern "C" void rtc_lacks_a_functionInit(RTC::Manager* manager) {
    register_type(manager, "Incomplete",
                  [](RTC::Manager* owner) -> RTC::RTObject_impl* { return new Incomplete(owner); });
}

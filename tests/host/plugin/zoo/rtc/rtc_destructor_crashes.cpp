// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/rtc.hpp"
namespace {
int* volatile nowhere = nullptr;
class Fragile : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    ~Fragile() override { *nowhere = 1; }
};
} // namespace
extern "C" void rtc_destructor_crashesInit(RTC::Manager* manager) {
    register_type(manager, "Fragile",
                  [](RTC::Manager* owner) -> RTC::RTObject_impl* { return new Fragile(owner); });
}

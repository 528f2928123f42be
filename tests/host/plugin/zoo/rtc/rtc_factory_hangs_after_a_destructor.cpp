// SPDX-License-Identifier: Apache-2.0
// Two types: the destructor of one hangs, and the factory of the other hangs.
#include "tests/host/plugin/zoo/rtc.hpp"
#include <unistd.h>
namespace {
class EndlessPause : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    ~EndlessPause() override {
        for (;;) pause();
    }
};
} // namespace
extern "C" void rtc_factory_hangs_after_a_destructorInit(RTC::Manager* manager) {
    register_type(manager, "Endless",
                  [](RTC::Manager* owner) -> RTC::RTObject_impl* { return new EndlessPause(owner); });
    register_type(manager, "Waiter", [](RTC::Manager*) -> RTC::RTObject_impl* {
        for (;;) pause();
    });
}

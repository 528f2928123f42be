// SPDX-License-Identifier: Apache-2.0
// It waits for a thread that never ends.
#include "tests/host/plugin/zoo/rtc.hpp"
#include <chrono>
#include <thread>
namespace {
class Endless : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    ~Endless() override { thread_.join(); }

  private:
    std::thread thread_{[] {
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    }};
};
} // namespace
extern "C" void rtc_destructor_hangsInit(RTC::Manager* manager) {
    register_type(manager, "Endless",
                  [](RTC::Manager* owner) -> RTC::RTObject_impl* { return new Endless(owner); });
}

// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/rtc.hpp"
#include <stdexcept>
namespace {
class Thrower : public RTC::DataFlowComponentBase {
  public:
    explicit Thrower(RTC::Manager* manager) : DataFlowComponentBase(manager) {
        throw std::runtime_error("no gripper");
    }
};
} // namespace
extern "C" void rtc_constructor_throwsInit(RTC::Manager* manager) {
    register_type(manager, "Thrower",
                  [](RTC::Manager* owner) -> RTC::RTObject_impl* { return new Thrower(owner); });
}

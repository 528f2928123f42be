// SPDX-License-Identifier: Apache-2.0
// A library of components for rtm_host, with some that behave badly.
#include "components.hpp"
#include <cstdio>

namespace {

using namespace testing;

/// Says on standard output what it received, once it is 10.
class Teller : public Summer {
  public:
    using Summer::Summer;
    RTC::ReturnCode_t onExecute(RTC::UniqueId id) override {
        Summer::onExecute(id);
        if (received_ >= 10 && !told_) {
            std::printf("received %ld\n", received_.load());
            std::fflush(stdout);
            told_ = true;
        }
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        std::printf("%s deactivated\n", getInstanceName());
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onFinalize() override {
        std::printf("%s finalized\n", getInstanceName());
        return RTC::RTC_OK;
    }

  private:
    bool told_ = false;
};

class Thrower : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override { throw std::runtime_error("on purpose"); }
    RTC::ReturnCode_t onAborting(RTC::UniqueId) override {
        std::puts("aborting");
        std::fflush(stdout);
        return RTC::RTC_OK;
    }
};

class Hanger : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        std::puts("hanging");
        std::fflush(stdout);
        std::this_thread::sleep_for(std::chrono::hours(1));
        return RTC::RTC_OK;
    }
};

} // namespace

extern "C" void TestComponentsInit(RTC::Manager* manager) {
    register_all(*manager);
    register_as<Teller>(*manager, "Teller");
    register_as<Thrower>(*manager, "Thrower");
    register_as<Hanger>(*manager, "Hanger");
}
extern "C" void OnlyTellers(RTC::Manager* manager) { register_as<Teller>(*manager, "Teller"); }

// SPDX-License-Identifier: Apache-2.0
// The RT-Component of the calls across the bridge. It answers calls. With the property `file` it also makes
// and times them.
#include "BenchBridgeSkel.h"

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

#include "apps/bench/tandem/bridge/call_timer.hpp"

#include <memory>
#include <optional>

using namespace tandem::bench;

namespace {

/// The servant behind the provided service port. [worker of the proxy]
class Adder : public POA_Bench::Adder, public PortableServer::RefCountServantBase {
  public:
    CORBA::Double add(CORBA::Double a, CORBA::Double b) override {
        if (floor) floor->note_call();
        return a + b;
    }
    std::unique_ptr<FloorAdder> floor; ///< of a paired case
};

} // namespace

class BenchCallRtc : public RTC::DataFlowComponentBase {
  public:
    explicit BenchCallRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        Clock::calibrate();
        provided_.registerProvider("adder", "Bench::Adder", servant_);
        required_.registerConsumer("adder", "Bench::Adder", adder_);
        addPort(provided_);
        addPort(required_);
        const auto settings = CallSettings::from(
            [this](const char* name) -> std::string { return getProperties().getProperty(name); });
        if (!settings.file.empty())
            timer_ = std::make_unique<CallTimer>(settings);
        else if (!settings.floor.empty())
            servant_.floor = std::make_unique<FloorAdder>(settings);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (!timer_) return RTC::RTC_OK;
        timer_->call_for_a_slice([this](double a, double b) -> std::optional<double> {
            try {
                return adder_->add(a, b);
            } catch (const CORBA::Exception&) { // until the peer is connected
                return std::nullopt;
            }
        });
        return RTC::RTC_OK;
    }

  private:
    RTC::CorbaPort provided_{"provided"}, required_{"required"};
    Adder servant_;
    RTC::CorbaConsumer<Bench::Adder> adder_;
    std::unique_ptr<CallTimer> timer_;
};

extern "C" void BenchCallRtcInit(RTC::Manager* manager) {
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "BenchCallRtc");
    profile.setProperty("category", "bench");
    manager->registerFactory(profile, RTC::Create<BenchCallRtc>, RTC::Delete<BenchCallRtc>);
}

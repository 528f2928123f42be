// SPDX-License-Identifier: Apache-2.0
// The chair's hardware as an RTC: publishes stick and wheel speeds, receives voltages, stops safely.
#include <atomic>

#include "WheelchairSkel.h"
#include "component.hpp"
#include "plugins/wheelchair/core/body/hw_body.hpp"
#include "plugins/wheelchair/core/law/limits.hpp"

using namespace tandem::wheelchair;

namespace {

// The servant's caller releases the sequence, according to the CORBA C++ mapping.
Wheelchair::Values* values(const std::vector<double>& from) {
    auto* out = new Wheelchair::Values;
    out->length(from.size());
    std::copy(from.begin(), from.end(), out->get_buffer());
    return out;
}

/// The servant of service chair. ORB threads call it.
class ChairService : public POA_Wheelchair::Chair, public virtual PortableServer::RefCountServantBase {
  public:
    Wheelchair::Values* parameters() override { return values(chair_parameters()); }
    Wheelchair::Values* limits() override { return values(chair_limits()); }
    CORBA::Boolean emergency_stop() override { return emergency_ = true; }

    std::atomic<bool> emergency_{false}; // set by the service, read in each tick
};

/// HWBody with the ports, configuration sets and life cycle of an RTC.
class HWComp : public RTC::DataFlowComponentBase, private HWPorts {
  public:
    explicit HWComp(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager), chairPort_("chair") {}

    RTC::ReturnCode_t onInitialize() override {
        // Port names are those of docs/wheelchair.md, section 5, in both component models.
        registerInPort("refVoltage", refVoltage_.port);
        registerInPort("linkState", linkState_.port);
        registerOutPort("joystickPos", joystickPos_.port);
        registerOutPort("wheelSpeed", wheelSpeed_.port);
        chairPort_.registerProvider("chair", "Wheelchair::Chair", chair_);
        registerPort(chairPort_);
        parameters_.bind(*this);
        return RTC::RTC_OK;
    }

    // Publishes once, so that the other components find values in their first tick. Each activation creates a new body,
    // which resets counters, law and safety state.
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        return component::run_guarded(getInstanceName(), [this] {
            chair_.emergency_ = false;
            body_.reset(); // closes the trace of an earlier activation
            body_ = std::make_unique<HWBody>(read_settings(parameters_.texts));
            body_->publish(*this);
        });
    }

    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (chair_.emergency_) body_->emergency_stop();
        body_->tick(*this);
        return RTC::RTC_OK;
    }

    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return stop(); }
    RTC::ReturnCode_t onAborting(RTC::UniqueId) override { return stop(); }
    RTC::ReturnCode_t onFinalize() override { return stop(); }

  private:
    // Stops safely without any other component and without a tick.
    RTC::ReturnCode_t stop() {
        if (body_) body_->stop();
        return RTC::RTC_OK;
    }

    Received<Voltage> voltages() override { return refVoltage_.receive_all<Voltage>(); }
    Received<LinkState> link_states() override { return linkState_.receive_all<LinkState>(); }
    void send(const Stamped<JoystickPosition>& position, const Stamped<WheelSpeed>& wheels) override {
        // joystickPos is last, because JoystickComp reacts to it, and ControlComp then finds the wheel speeds of the
        // same tick.
        wheelSpeed_.write(wheels);
        joystickPos_.write(position);
    }

    component::SequenceIn refVoltage_{"refVoltage"}, linkState_{"linkState"};
    component::SequenceOut joystickPos_{"joystickPos"}, wheelSpeed_{"wheelSpeed"};
    RTC::CorbaPort chairPort_;
    ChairService chair_;
    component::Parameters parameters_;
    std::unique_ptr<HWBody> body_;
};

} // namespace

extern "C" void HWCompInit(RTC::Manager* manager) {
    coil::Properties profile =
        component::profile("HWComp", "Simulated wheelchair: motors, encoders, joystick inputs");
    manager->registerFactory(profile, RTC::Create<HWComp>, RTC::Delete<HWComp>);
}

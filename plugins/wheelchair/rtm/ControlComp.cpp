// SPDX-License-Identifier: Apache-2.0
// The controller as an RTC: converts reference and wheel speeds to motor voltages.
#include "WheelchairSkel.h"
#include "component.hpp"
#include "plugins/wheelchair/core/body/control_body.hpp"
#include "plugins/wheelchair/core/law/limits.hpp"

using namespace tandem::wheelchair;

/// ControlBody with the ports, configuration sets and life cycle of an RTC.
class ControlComp : public RTC::DataFlowComponentBase, private ControlPorts {
  public:
    explicit ControlComp(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), joystickPort_("joystick") {}

    RTC::ReturnCode_t onInitialize() override {
        registerInPort("reference", reference_.port);
        registerInPort("wheelSpeed", wheelSpeed_.port);
        registerOutPort("refVoltage", refVoltage_.port);
        joystickPort_.registerConsumer("joystick", "Wheelchair::Joystick", joystick_);
        registerPort(joystickPort_);
        parameters_.bind(*this);
        bindParameter("poll_us", parameters_.texts.poll_us, "0");
        bindParameter("ratio_gain", ratio_gain_, "16");
        return RTC::RTC_OK;
    }

    // Each activation creates a new body, which resets counters, law and safety state.
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        return component::run_guarded(getInstanceName(), [this] {
            ask_joystick();
            body_.reset(); // closes the trace of an earlier activation
            Settings settings = read_settings(parameters_.texts);
            settings.ratio_gain = read_ratio_gain(ratio_gain_);
            body_ = std::make_unique<ControlBody>(settings);
        });
    }

    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        body_->tick(*this);
        return RTC::RTC_OK;
    }

    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return stop(); }
    RTC::ReturnCode_t onAborting(RTC::UniqueId) override { return stop(); }

  private:
    // The first call over the service port, so that an unconnected port fails at activation and not during the run.
    void ask_joystick() {
        if (CORBA::is_nil(joystick_._ptr()))
            throw InputError(
                "port joystick is not connected; connect it to a provider of Wheelchair::Joystick");
        check_joystick(joystick_->dead_zone(), joystick_->direction_rate());
    }

    // This component's last command to HWComp. Without it, the watchdog would act 50 ms later.
    RTC::ReturnCode_t stop() {
        if (body_) body_->deactivate(*this);
        return RTC::RTC_OK;
    }

    Received<Reference> references() override { return reference_.receive_all<Reference>(); }
    Received<WheelSpeed> wheels() override { return wheelSpeed_.receive_all<WheelSpeed>(); }
    void send(const Stamped<Voltage>& voltage) override { refVoltage_.write(voltage); }

    component::SequenceIn reference_{"reference"}, wheelSpeed_{"wheelSpeed"};
    component::SequenceOut refVoltage_{"refVoltage"};
    RTC::CorbaPort joystickPort_;
    RTC::CorbaConsumer<Wheelchair::Joystick> joystick_;
    component::Parameters parameters_;
    std::string ratio_gain_;
    std::unique_ptr<ControlBody> body_;
};

extern "C" void ControlCompInit(RTC::Manager* manager) {
    coil::Properties profile =
        component::profile("ControlComp", "Speed-ratio control of the wheelchair's drive motors");
    profile.setProperty("conf.default.poll_us", "0");
    profile.setProperty("conf.default.ratio_gain", "16");
    manager->registerFactory(profile, RTC::Create<ControlComp>, RTC::Delete<ControlComp>);
}

// SPDX-License-Identifier: Apache-2.0
// The joystick as an RTC: converts stick positions to reference direction and speed.
#include <atomic>

#include "WheelchairSkel.h"
#include "component.hpp"
#include "plugins/wheelchair/core/body/joystick_body.hpp"

using namespace tandem::wheelchair;

namespace {

/// The servant of service joystick. ORB threads call it.
class JoystickService : public POA_Wheelchair::Joystick, public virtual PortableServer::RefCountServantBase {
  public:
    CORBA::Double dead_zone() override { return JoystickParameters{}.dead_zone; }
    CORBA::Double direction_rate() override { return direction_rate_; }
    void set_direction_rate(double degrees_per_second) { direction_rate_ = degrees_per_second; }

  private:
    std::atomic<double> direction_rate_{JoystickParameters{}.direction_rate};
};

// Calls limits() of service chair. Throws InputError if the port is not connected, and CORBA exceptions if the call
// fails.
std::vector<double> limits(Wheelchair::Chair_ptr chair) {
    if (CORBA::is_nil(chair))
        throw InputError("port chair is not connected; connect it to a provider of Wheelchair::Chair");
    const Wheelchair::Values_var answer = chair->limits();
    return {answer->get_buffer(), answer->get_buffer() + answer->length()};
}

/// JoystickBody with the ports, configuration sets and life cycle of an RTC.
class JoystickComp : public RTC::DataFlowComponentBase, private JoystickPorts {
  public:
    explicit JoystickComp(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), joystickPort_("joystick"), chairPort_("chair") {}

    RTC::ReturnCode_t onInitialize() override {
        registerInPort("joystickPos", joystickPos_.port);
        registerOutPort("reference", reference_.port);
        joystickPort_.registerProvider("joystick", "Wheelchair::Joystick", joystick_);
        chairPort_.registerConsumer("chair", "Wheelchair::Chair", chair_);
        registerPort(joystickPort_);
        registerPort(chairPort_);
        parameters_.bind(*this);
        return RTC::RTC_OK;
    }

    // Each activation creates a new body, which resets counters, law and safety state.
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        return component::run_guarded(getInstanceName(), [this] {
            body_.reset(); // closes the trace of an earlier activation
            const Settings settings = read_settings(parameters_.texts);
            joystick_.set_direction_rate(settings.scenario.direction_rate);
            body_ = std::make_unique<JoystickBody>(settings, limits(chair_._ptr()));
        });
    }

    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        body_->tick(*this);
        return RTC::RTC_OK;
    }

  private:
    Received<JoystickPosition> positions() override { return joystickPos_.receive_all<JoystickPosition>(); }
    void send(const Stamped<Reference>& reference) override { reference_.write(reference); }

    component::SequenceIn joystickPos_{"joystickPos"};
    component::SequenceOut reference_{"reference"};
    RTC::CorbaPort joystickPort_, chairPort_;
    std::unique_ptr<JoystickBody> body_;
    JoystickService joystick_;
    RTC::CorbaConsumer<Wheelchair::Chair> chair_;
    component::Parameters parameters_;
};

} // namespace

extern "C" void JoystickCompInit(RTC::Manager* manager) {
    coil::Properties profile =
        component::profile("JoystickComp", "Stick position to reference direction and speed");
    manager->registerFactory(profile, RTC::Create<JoystickComp>, RTC::Delete<JoystickComp>);
}

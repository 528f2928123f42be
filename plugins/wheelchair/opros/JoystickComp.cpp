// SPDX-License-Identifier: Apache-2.0
// The joystick as an OPRoS component: converts stick positions to reference direction and speed.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "ChairRequired.h"
#include "JoystickProvided.h"
#include "component.hpp"
#include "plugins/wheelchair/core/body/joystick_body.hpp"

using namespace tandem::wheelchair;

/// JoystickBody with the ports, properties and life cycle of an OPRoS component.
class JoystickComp : public Component, public IJoystick, private JoystickPorts {
  public:
    JoystickComp() { portSetup(); }

    double dead_zone() override { return JoystickParameters{}.dead_zone; }
    double direction_rate() override { return settings_.scenario.direction_rate; }

    ReturnType onExecute() override {
        body_->tick(*this);
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override {
        return component::run_guarded("JoystickComp", [this] { settings_ = component::settings_of(*this); });
    }

    // Requests the chair's limits from HWComp, which must be started before. Each start creates a new body, which
    // resets counters, law and safety state.
    ReturnType onStart() override {
        return component::run_guarded("JoystickComp", [this] {
            body_.reset(); // closes the trace of an earlier start
            body_ = std::make_unique<JoystickBody>(settings_, chair_->limits());
        });
    }

    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    void portSetup() {
        addPort("joystick", new JoystickProvided(this));
        addPort("chair", chair_);
        addPort("joystickPos", &joystickPos_);
        addPort("reference", &reference_);
    }

    Received<JoystickPosition> positions() override {
        return component::receive_all<JoystickPosition>(joystickPos_);
    }
    void send(const Stamped<Reference>& reference) override {
        component::push(reference_, buffer_, reference);
    }

    ChairRequired* chair_ = new ChairRequired; // the component deletes its service ports
    InputDataPort<component::Values> joystickPos_{OPROS_FIFO, component::queue_length};
    OutputDataPort<component::Values> reference_;
    component::Values buffer_;
    Settings settings_;
    std::unique_ptr<JoystickBody> body_;
};

extern "C" {
Component* getComponent() { return new JoystickComp; }
void releaseComponent(Component* component) { delete component; }
}

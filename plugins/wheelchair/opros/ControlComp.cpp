// SPDX-License-Identifier: Apache-2.0
// The controller as an OPRoS component: converts reference and wheel speeds to motor voltages.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "JoystickRequired.h"
#include "component.hpp"
#include "plugins/wheelchair/core/body/control_body.hpp"
#include "plugins/wheelchair/core/law/limits.hpp"

using namespace tandem::wheelchair;

/// ControlBody with the ports, properties and life cycle of an OPRoS component.
class ControlComp : public Component, private ControlPorts {
  public:
    ControlComp() { portSetup(); }

    ReturnType onExecute() override {
        body_->tick(*this);
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override {
        return component::run_guarded("ControlComp", [this] {
            settings_ = component::settings_of(*this);
            settings_.ratio_gain = read_ratio_gain(getProperty("ratio_gain"));
        });
    }

    // The first call over the service port, so that an unconnected port fails here and not during the run. Each start
    // creates a new body, which resets counters, law and safety state.
    ReturnType onStart() override {
        return component::run_guarded("ControlComp", [this] {
            check_joystick(joystick_->dead_zone(), joystick_->direction_rate());
            body_.reset(); // closes the trace of an earlier start
            body_ = std::make_unique<ControlBody>(settings_);
        });
    }

    ReturnType onStop() override { return stop_chair(); }
    ReturnType onReset() override { return stop_chair(); }
    ReturnType onError() override { return stop_chair(); }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    void portSetup() {
        addPort("joystick", joystick_);
        addPort("reference", &reference_);
        addPort("wheelSpeed", &wheelSpeed_);
        addPort("refVoltage", &refVoltage_);
    }

    // This component's last command to HWComp. Without it, the watchdog would act 50 ms later.
    ReturnType stop_chair() {
        if (body_) body_->deactivate(*this);
        return OPROS_SUCCESS;
    }

    Received<Reference> references() override { return component::receive_all<Reference>(reference_); }
    Received<WheelSpeed> wheels() override { return component::receive_all<WheelSpeed>(wheelSpeed_); }
    void send(const Stamped<Voltage>& voltage) override { component::push(refVoltage_, buffer_, voltage); }

    JoystickRequired* joystick_ = new JoystickRequired; // the component deletes its service ports
    InputDataPort<component::Values> reference_{OPROS_FIFO, component::queue_length};
    InputDataPort<component::Values> wheelSpeed_{OPROS_FIFO, component::queue_length};
    OutputDataPort<component::Values> refVoltage_;
    component::Values buffer_;
    Settings settings_;
    std::unique_ptr<ControlBody> body_;
};

extern "C" {
Component* getComponent() { return new ControlComp; }
void releaseComponent(Component* component) { delete component; }
}

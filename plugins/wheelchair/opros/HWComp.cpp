// SPDX-License-Identifier: Apache-2.0
// The chair's hardware as an OPRoS component: publishes stick and wheel speeds, receives voltages, stops safely.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include <atomic>

#include "ChairProvided.h"
#include "component.hpp"
#include "plugins/wheelchair/core/body/hw_body.hpp"
#include "plugins/wheelchair/core/law/limits.hpp"

using namespace tandem::wheelchair;

/// HWBody with the ports, properties and life cycle of an OPRoS component.
class HWComp : public Component, public IChair, private HWPorts {
  public:
    HWComp() { portSetup(); }

    std::vector<double> parameters() override { return chair_parameters(); }
    std::vector<double> limits() override { return chair_limits(); }
    bool emergency_stop() override { return emergency_ = true; }

    // A service call may come in any thread. It only sets a flag, which takes effect here.
    ReturnType onExecute() override {
        if (emergency_) body_->emergency_stop();
        body_->tick(*this);
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override {
        return component::run_guarded("HWComp", [this] { settings_ = component::settings_of(*this); });
    }

    // Publishes once, so that the other components find values in their first tick. Each start creates a new body,
    // which resets counters, law and safety state.
    ReturnType onStart() override {
        return component::run_guarded("HWComp", [this] {
            emergency_ = false;
            body_.reset(); // closes the trace of an earlier start
            body_ = std::make_unique<HWBody>(settings_);
            body_->publish(*this);
        });
    }

    ReturnType onStop() override { return stop_chair(); }
    ReturnType onReset() override { return stop_chair(); }
    ReturnType onError() override { return stop_chair(); }
    ReturnType onRecover() override { return stop_chair(); }
    ReturnType onDestroy() override { return stop_chair(); }

  private:
    void portSetup() {
        addPort("chair", new ChairProvided(this));
        addPort("refVoltage", &refVoltage_);
        addPort("linkState", &linkState_);
        addPort("joystickPos", &joystickPos_);
        addPort("wheelSpeed", &wheelSpeed_);
    }

    // Stops safely without any other component and without a tick.
    ReturnType stop_chair() {
        if (body_) body_->stop();
        return OPROS_SUCCESS;
    }

    Received<Voltage> voltages() override { return component::receive_all<Voltage>(refVoltage_); }
    Received<LinkState> link_states() override { return component::receive_all<LinkState>(linkState_); }
    void send(const Stamped<JoystickPosition>& position, const Stamped<WheelSpeed>& wheels) override {
        // joystickPos is last, because JoystickComp reacts to it, and ControlComp then finds the wheel speeds of the
        // same tick.
        component::push(wheelSpeed_, buffer_, wheels);
        component::push(joystickPos_, buffer_, position);
    }

    InputDataPort<component::Values> refVoltage_{OPROS_FIFO, component::queue_length};
    InputDataPort<component::Values> linkState_{OPROS_FIFO, component::queue_length};
    OutputDataPort<component::Values> joystickPos_, wheelSpeed_;
    component::Values buffer_;
    Settings settings_;
    std::unique_ptr<HWBody> body_;
    std::atomic<bool> emergency_{false}; // set by the service, read in each tick
};

extern "C" {
Component* getComponent() { return new HWComp; }
void releaseComponent(Component* component) { delete component; }
}

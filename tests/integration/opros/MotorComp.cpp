// SPDX-License-Identifier: Apache-2.0
// Answers each speed with speed x gain; its property `fails` names the callback that fails.
#include <OPRoSInclude.h>

#include <iostream>
#include <memory>
#include <stdexcept>
#include <syncstream>

class MotorComp : public Component {
  public:
    MotorComp() {
        addPort("speed", &speed_);
        addPort("torque", &torque_);
        addPort("angles", &angles_);
        addPort("count", &count_);
    }

    ReturnType onExecute() override {
        if (fails("execute")) throw std::runtime_error("overheated");
        while (const std::unique_ptr<opros_any> speed{speed_.pop()}) {
            const double torque = speed_.getContent(*speed) * std::stod(getProperty("gain"));
            torque_.push(torque);
            angles_.push({torque, -torque});
            say("torque " + std::to_string(torque));
        }
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override { return said("initialized"); }
    ReturnType onStart() override { return fails("start") ? OPROS_CALLER_ERROR : said("started"); }
    ReturnType onStop() override { return fails("stop") ? OPROS_CALLER_ERROR : said("stopped"); }
    ReturnType onReset() override { return said("reset"); }
    ReturnType onError() override { return said("in error"); }
    ReturnType onRecover() override { return fails("recover") ? OPROS_CALLER_ERROR : said("recovered"); }
    ReturnType onDestroy() override { return said("destroyed"); }

  private:
    bool fails(const std::string& callback) { return getProperty("fails") == callback; }
    void say(const std::string& what) { std::osyncstream(std::cout) << getId() + " " + what << std::endl; }
    ReturnType said(const std::string& what) {
        say(what);
        return OPROS_SUCCESS;
    }

    InputDataPort<double> speed_;
    OutputDataPort<double> torque_;
    OutputDataPort<std::vector<double>> angles_;
    OutputDataPort<long> count_; // RTM has no standard type with 64 bits
};

extern "C" {
Component* getComponent() { return new MotorComp; }
void releaseComponent(Component* component) { delete component; }
}

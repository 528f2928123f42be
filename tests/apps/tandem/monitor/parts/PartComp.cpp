// SPDX-License-Identifier: Apache-2.0
// Sends a sine, plus the number that it received last, and a cosine.
#include <OPRoSInclude.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

class PartComp : public Component {
  public:
    PartComp() {
        addPort("in", &in_);
        addPort("out", &out_);
    }
    ReturnType onExecute() override {
        while (const std::unique_ptr<opros_any> message{in_.pop()})
            received_ = *in_.getContentPointer(*message);
        const double amplitude = std::stod(getProperty("amplitude"));
        time_ += 0.01;
        std::vector<double> numbers{amplitude * std::sin(time_), amplitude * std::cos(time_)};
        if (!received_.empty()) numbers[0] += received_[0];
        out_.push(numbers);
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    double time_ = 0;
    std::vector<double> received_;
    InputDataPort<std::vector<double>> in_;
    OutputDataPort<std::vector<double>> out_;
};

extern "C" {
Component* getComponent() { return new PartComp; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// Sends the twenty numbers around the largest 16-bit number, one in each cycle, and prints what it receives.
#include "simple_component.h"

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>

class RangeComp : public SimpleComponent {
  public:
    RangeComp() {
        addPort("number", &number_);
        addPort("small", &small_);
    }
    ReturnType onExecute() override {
        if (last_ < 32777) small_.push(++last_);
        while (const std::unique_ptr<opros_any> value{number_.pop()})
            std::osyncstream(std::cout) << "RangeComp number " << number_.getContent(*value) << std::endl;
        return OPROS_SUCCESS;
    }

  private:
    InputDataPort<short> number_;
    OutputDataPort<int> small_;
    int last_ = 32757;
};

extern "C" {
Component* getComponent() { return new RangeComp; }
void releaseComponent(Component* component) { delete component; }
}

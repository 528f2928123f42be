// SPDX-License-Identifier: Apache-2.0
// Sends the time in each cycle until it has done so `count` times, and takes times that come.
#include "tests/integration/opros/simple_component.h"
#include "tests/integration/remote/stamps.hpp"

#include <OPRoSInclude.h>

#include <iostream>
#include <memory>
#include <syncstream>

class StampComp : public SimpleComponent {
  public:
    StampComp() {
        addPort("there", &there_);
        addPort("back", &back_);
    }
    ReturnType onExecute() override {
        const double count = std::stod(getProperty("count"));
        if (sent_ < count) there_.push({++sent_, Stamps::now(), count});
        while (const std::unique_ptr<opros_any> message{back_.pop()}) {
            const auto content = back_.getContent(*message);
            if (stamps_.take(content.at(0), content.at(1), content.at(2)))
                std::osyncstream(std::cout) << "back: " << stamps_.text() << std::endl;
        }
        return OPROS_SUCCESS;
    }

  private:
    double sent_ = 0;
    Stamps stamps_;
    OutputDataPort<std::vector<double>> there_;
    InputDataPort<std::vector<double>> back_{OPROS_FIFO, 1000};
};

extern "C" {
Component* getComponent() { return new StampComp; }
void releaseComponent(Component* component) { delete component; }
}

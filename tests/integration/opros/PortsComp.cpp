// SPDX-License-Identifier: Apache-2.0
// Sends a separate value through each of out0 to out7 until all have come back through in0 to in7, and
// reports this.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>
#include <vector>

class PortsComp : public SimpleComponent {
  public:
    PortsComp() {
        for (int i = 0; i < ports; ++i) {
            addPort("out" + std::to_string(i), &out_[i]);
            addPort("in" + std::to_string(i), &in_[i]);
        }
    }
    ReturnType onExecute() override {
        if (told_) return OPROS_SUCCESS;
        const double number = std::stod(getProperty("number"));
        int right = 0;
        for (int i = 0; i < ports; ++i) {
            std::vector<double> value{number, static_cast<double>(i)};
            out_[i].push(value);
            while (const std::unique_ptr<opros_any> back{in_[i].pop()}) {
                came_[i] = in_[i].getContent(*back);
                if (came_[i] != value)
                    std::osyncstream(std::cout) << "wrong value of port " << i << std::endl;
            }
            right += came_[i] == value ? 1 : 0;
        }
        told_ = right == ports;
        if (told_)
            std::osyncstream(std::cout)
                << "all ports of number " << getProperty("number") << " crossed" << std::endl;
        return OPROS_SUCCESS;
    }

  private:
    static constexpr int ports = 8;
    OutputDataPort<std::vector<double>> out_[ports];
    InputDataPort<std::vector<double>> in_[ports];
    std::vector<double> came_[ports];
    bool told_ = false;
};

extern "C" {
Component* getComponent() { return new PortsComp; }
void releaseComponent(Component* component) { delete component; }
}

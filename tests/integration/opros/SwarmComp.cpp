// SPDX-License-Identifier: Apache-2.0
// One of several senders and receivers: sends numbers with its property `number`, and tells when those of all senders have come back
// from all RTCs, each in order and once.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <syncstream>
#include <vector>

class SwarmComp : public SimpleComponent {
  public:
    SwarmComp() {
        addPort("out", &out_);
        addPort("in", &in_);
    }
    ReturnType onExecute() override {
        if (sent_ < messages) out_.push({std::stoi(getProperty("number")), ++sent_});
        while (const std::unique_ptr<opros_any> message{in_.pop()}) take(in_.getContent(*message));
        return OPROS_SUCCESS;
    }

  private:
    /// {RTC, sender, number}
    void take(const std::vector<int>& message) {
        int& last = last_[{message.at(0), message.at(1)}];
        if (message.at(2) != last + 1)
            std::osyncstream(std::cout)
                << "swarm: " << last << " is followed by " << message.at(2) << std::endl;
        last = message.at(2);
        if (last == messages && ++complete_ == 4)
            std::osyncstream(std::cout)
                << "swarm " << getProperty("number") << ": all have come" << std::endl;
    }

    static constexpr int messages = 50;
    int sent_ = 0, complete_ = 0;
    std::map<std::pair<int, int>, int> last_;
    OutputDataPort<std::vector<int>> out_;
    InputDataPort<std::vector<int>> in_{OPROS_FIFO, 1000};
};

extern "C" {
Component* getComponent() { return new SwarmComp; }
void releaseComponent(Component* component) { delete component; }
}

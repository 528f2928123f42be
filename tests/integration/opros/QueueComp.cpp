// SPDX-License-Identifier: Apache-2.0
// Sends fifty numbers to the RTC and to its own ports, and prints the content of its ports when fifty have
// come from the RTC.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>

class QueueComp : public SimpleComponent {
  public:
    QueueComp() {
        addPort("out", &out_);
        addPort("go", &go_);
        addPort("done", &done_);
        addPort("both", &both_);
        for (auto& pair : pairs_) {
            addPort(pair.name, &pair.across);
            addPort("local_" + pair.name, &pair.local);
        }
    }
    ReturnType onExecute() override {
        if (!sent_) send();
        sent_ = true;
        if (const std::unique_ptr<opros_any> done{done_.pop()}) print_all();
        return OPROS_SUCCESS;
    }

  private:
    struct Pair {
        Pair(std::string name, DataPortPolicy policy, unsigned int limit)
            : name(std::move(name)), across(policy, limit), local(policy, limit) {}
        std::string name;
        InputDataPort<int> across, local;
    };
    void send() {
        int refused = 0;
        for (int i = 1; i <= 50; ++i)
            if (out_.push(i) == OPROS_OUT_OF_RESOURCES) ++refused;
        std::osyncstream(std::cout) << "refused: " << refused << std::endl;
        go_.push(1);
    }
    void print_all() {
        for (auto& pair : pairs_) {
            print(pair.name, pair.across);
            print("local_" + pair.name, pair.local);
        }
        print("both", both_);
        std::osyncstream(std::cout) << "all queues are printed" << std::endl;
    }
    static void print(const std::string& name, InputDataPort<int>& port) {
        std::string line = name + ":";
        while (const std::unique_ptr<opros_any> value{port.pop()})
            line += " " + std::to_string(port.getContent(*value));
        std::osyncstream(std::cout) << line << "." << std::endl;
    }

    bool sent_ = false;
    OutputDataPort<int> out_, go_;
    InputDataPort<int> done_;
    InputDataPort<int> both_{OPROS_FIFO, 4}; ///< of this component's numbers and then of the RTC's
    Pair pairs_[7]{{"sole", OPROS_FIFO, 4},     {"last", OPROS_LAST, 1},  {"fifo1", OPROS_FIFO, 1},
                   {"fifo4", OPROS_FIFO, 4},    {"lifo4", OPROS_LIFO, 4}, {"ufifo4", OPROS_UFIFO, 4},
                   {"fifo200", OPROS_FIFO, 200}};
};

extern "C" {
Component* getComponent() { return new QueueComp; }
void releaseComponent(Component* component) { delete component; }
}

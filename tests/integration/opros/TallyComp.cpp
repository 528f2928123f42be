// SPDX-License-Identifier: Apache-2.0
// Sends numbered messages by `back`, and prints which messages it receives and which numbers of `steady` are missing. With the
// first value of `late` it adds a port `lateOut`, by which it sends numbers from 100000 on, and a port `lateIn`. Its property
// `stage`, when it becomes `double`, makes these two ports of doubles by the same names, and when it becomes `int` whole
// numbers again.
#include "simple_component.h"

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>

class TallyComp : public SimpleComponent {
  public:
    TallyComp() {
        addPort("steady", &steady_);
        addPort("activated", &activated_);
        addPort("late", &late_);
        addPort("lateDouble", &lateDouble_);
        addPort("lateOutDouble", &lateOutDouble_);
        addPort("back", &back_);
    }

    ReturnType onExecute() override {
        back_.push(++number_);
        take(steady_, [this](int value) {
            if (last_steady_ != 0 && value != last_steady_ + 1) say("steady lacks a number");
            last_steady_ = value;
        });
        take(activated_, [this](int value) { say("activated " + std::to_string(value)); });
        take(late_, [this](int value) {
            say("late " + std::to_string(value));
            if (late_number_ == 0) add_ports();
        });
        take(lateDouble_, [this](double value) { say("lateDouble " + std::to_string(value)); });
        lateOutDouble_.push(number_ + 0.25);
        if (late_number_ != 0) lateOut_.push(late_number_++);
        take(lateIn_, [this](int value) { say("lateIn " + std::to_string(value)); });
        changingOut_.push(number_ + 0.125);
        take(changingIn_, [this](double value) { say("changingIn " + std::to_string(value)); });
        if (late_number_ != 0) enter(getProperty("stage"));
        return OPROS_SUCCESS;
    }

  private:
    template <class Value, class Use>
    static void take(InputDataPort<Value>& port, const Use& use) {
        while (const std::unique_ptr<opros_any> value{port.pop()}) use(port.getContent(*value));
    }
    void add_ports() {
        late_number_ = 100'000;
        addPort("lateOut", &lateOut_);
        addPort("lateIn", &lateIn_);
    }
    void enter(const std::string& stage) {
        if (stage == stage_ || stage.empty()) return;
        stage_ = stage;
        removePort("lateOut");
        removePort("lateIn");
        addPort("lateOut", stage == "double" ? static_cast<Port*>(&changingOut_) : &lateOut_);
        addPort("lateIn", stage == "double" ? static_cast<Port*>(&changingIn_) : &lateIn_);
    }
    void say(const std::string& what) { std::osyncstream(std::cout) << getId() + " " + what << std::endl; }

    InputDataPort<int> steady_{OPROS_FIFO, 1000}, activated_, late_, lateIn_;
    InputDataPort<double> lateDouble_, changingIn_;
    OutputDataPort<int> back_, lateOut_;
    OutputDataPort<double> lateOutDouble_, changingOut_;
    std::string stage_ = "int";
    int number_ = 0, last_steady_ = 0, late_number_ = 0;
};

extern "C" {
Component* getComponent() { return new TallyComp; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// Raises an alarm in each cycle, and prints the events that come.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <string>
#include <syncstream>

class AlarmComp : public SimpleComponent {
  public:
    AlarmComp() {
        addPort("alarm", &alarm_);
        addPort("number", &number_);
        notice_.setOwner(this);
        addPort("notice", &notice_);
    }

    ReturnType onExecute() override {
        EventData<double> event;
        event.setId("hot " + std::to_string(++raised_));
        // The first one has no content: its type's default value crosses.
        if (raised_ > 1) event.setContentData(raised_ + 0.5);
        alarm_.push(&event);
        return OPROS_SUCCESS;
    }
    ReturnType onEvent(Event* event) override {
        const double* level = static_cast<EventData<double>*>(event)->getContentData();
        std::osyncstream(std::cout) << "event: " << event->getId() << ", " << (level ? *level : -1)
                                    << std::endl;
        return OPROS_SUCCESS;
    }

  private:
    int raised_ = 0;
    OutputEventPort<double> alarm_;
    OutputEventPort<int> number_;
    InputEventPort<double> notice_;
};

extern "C" {
Component* getComponent() { return new AlarmComp; }
void releaseComponent(Component* component) { delete component; }
}

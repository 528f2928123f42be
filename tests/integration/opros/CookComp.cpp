// SPDX-License-Identifier: Apache-2.0
// Presses one button of an oven in each cycle, over and over.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <string>

class CookComp : public SimpleComponent {
  public:
    CookComp() {
        addPort("button", &button_);
        addPort("label", &label_);
        addPort("weight", &weight_);
    }

    ReturnType onExecute() override {
        static const char* const ids[] = {"start", "minutes", "start", "tick", "tick", "bake"};
        EventData<int> event;
        event.setId(ids[pressed_++ % 6]);
        if (event.getId() == "minutes") event.setContentData(2);
        button_.push(&event);
        EventData<std::string> label;
        label.setId("label");
        label.setContentData("bread");
        label_.push(&label);
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onEvent(Event*) override { return OPROS_SUCCESS; }

  private:
    unsigned pressed_ = 0;
    OutputEventPort<int> button_;
    OutputEventPort<std::string> label_;
    OutputEventPort<double> weight_;
};

extern "C" {
Component* getComponent() { return new CookComp; }
void releaseComponent(Component* component) { delete component; }
}

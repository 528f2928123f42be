// SPDX-License-Identifier: Apache-2.0
// Prints the texts of the events that come.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <string>
#include <syncstream>

class WatchComp : public SimpleComponent {
  public:
    WatchComp() {
        late_.setOwner(this);
        addPort("late", &late_);
    }

    ReturnType onEvent(Event* event) override {
        const std::string* port = static_cast<EventData<std::string>*>(event)->getContentData();
        std::osyncstream(std::cout) << event->getId() + ": " + (port ? *port : "") + "\n" << std::flush;
        return OPROS_SUCCESS;
    }

  private:
    InputEventPort<std::string> late_;
};

extern "C" {
Component* getComponent() { return new WatchComp; }
void releaseComponent(Component* component) { delete component; }
}

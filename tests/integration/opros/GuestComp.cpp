// SPDX-License-Identifier: Apache-2.0
// Adds event ports and service ports when its property `stage` becomes `add`, and removes them at `remove`. Sends alarms and
// knocks, calls a dictionary, provides one, and prints what it receives.
#include "simple_component.h"

#include "DictionaryProvided.h"
#include "DictionaryRequired.h"

#include <ServiceUtils.h>

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>

class GuestComp : public SimpleComponent, public IDictionary {
  public:
    GuestComp() {
        notice_.setOwner(this);
        removed_dictionary_.reset(dictionary_);
        removed_shelf_.reset(new DictionaryProvided(this));
    }

    ReturnType onExecute() override {
        enter(getProperty("stage"));
        if (!is_there_) return OPROS_SUCCESS;
        EventData<double> alarm;
        alarm.setId("hot " + std::to_string(++raised_));
        alarm.setContentData(raised_ + 0.5);
        alarm_.push(&alarm);
        EventData<int> knock;
        knock.setId(raised_ % 2 == 0 ? "knock" : "wait");
        knock.setContentData(raised_);
        knock_.push(&knock);
        try {
            const auto pages = dictionary_->pages("hello", {1, 2});
            say("pages: " + std::to_string(pages.front()));
        } catch (MethodInvokeException& error) {
            say("refused: " + std::string(error.getMessage()));
        }
        return OPROS_SUCCESS;
    }
    ReturnType onEvent(Event* event) override {
        say("event: " + event->getId());
        return OPROS_SUCCESS;
    }
    std::vector<int> pages(std::string, std::vector<double> weights) override {
        return {static_cast<int>(10 * weights.size())};
    }

  private:
    void enter(const std::string& stage) {
        if (stage == "add" && !is_there_) {
            addPort("alarm", &alarm_);
            addPort("notice", &notice_);
            addPort("knock", &knock_);
            addPort("dictionary", removed_dictionary_.release()); // the component deletes its service ports
            addPort("shelf", removed_shelf_.release());
            is_there_ = true;
        } else if (stage == "remove" && is_there_) {
            removed_shelf_.reset(removePort("shelf"));
            removed_dictionary_.reset(removePort("dictionary"));
            for (const char* port : {"knock", "notice", "alarm"}) removePort(port);
            is_there_ = false;
            say("has removed its ports");
        }
    }
    void say(const std::string& what) { std::osyncstream(std::cout) << getId() + " " + what << std::endl; }

    bool is_there_ = false;
    int raised_ = 0;
    OutputEventPort<double> alarm_;
    OutputEventPort<int> knock_;
    InputEventPort<double> notice_;
    DictionaryRequired* const dictionary_ = new DictionaryRequired;
    std::unique_ptr<Port> removed_dictionary_, removed_shelf_; ///< while they are not ports of the component
};

extern "C" {
Component* getComponent() { return new GuestComp; }
void releaseComponent(Component* component) { delete component; }
}

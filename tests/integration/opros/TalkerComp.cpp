// SPDX-License-Identifier: Apache-2.0
// Sends a word in every cycle, prints the answer, and asks a service about it.
#include "simple_component.h"

#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "DictionaryRequired.h"

#include <iostream>
#include <memory>
#include <syncstream>

class TalkerComp : public SimpleComponent {
  public:
    TalkerComp() {
        addPort("word", &word_);
        addPort("numbers", &numbers_);
        addPort("reply", &reply_);
        addPort("dictionary", dictionary_);
    }

    ReturnType onExecute() override {
        word_.push("hello " + std::to_string(++said_));
        while (const std::unique_ptr<opros_any> reply{reply_.pop()}) {
            std::osyncstream(std::cout) << "reply: " << reply_.getContent(*reply) << std::endl;
            ask();
        }
        return OPROS_SUCCESS;
    }

  private:
    void ask() {
        try {
            const auto pages = dictionary_->pages("hello", {1.5, 2.5});
            std::osyncstream(std::cout) << "pages: " << pages.size() << " last " << pages.back() << std::endl;
            dictionary_->pages("unknown", {});
        } catch (MethodInvokeException& error) {
            std::osyncstream(std::cout) << "refused: " << error.getMessage() << std::endl;
        }
    }

    int said_ = 0;
    OutputDataPort<std::string> word_;
    OutputDataPort<std::vector<int>> numbers_;
    InputDataPort<std::string> reply_;
    DictionaryRequired* dictionary_ = new DictionaryRequired; // the component deletes its service ports
};

extern "C" {
Component* getComponent() { return new TalkerComp; }
void releaseComponent(Component* component) { delete component; }
}

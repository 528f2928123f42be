// SPDX-License-Identifier: Apache-2.0
// Provides a dictionary.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "DictionaryProvided.h"

#include <stdexcept>

class ShelfComp : public Component, public IDictionary {
  public:
    ShelfComp() {
        addPort("dictionary", new DictionaryProvided(this));
    } // the component deletes its service ports

    std::vector<int> pages(std::string word, std::vector<double> weights) override {
        if (word == "unknown") throw std::runtime_error("there is no such word");
        return {static_cast<int>(weights.size()), static_cast<int>(2 * weights.back())};
    }

  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }
};

extern "C" {
Component* getComponent() { return new ShelfComp; }
void releaseComponent(Component* component) { delete component; }
}

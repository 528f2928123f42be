// SPDX-License-Identifier: Apache-2.0
// The service that ShelfComp provides, in the style of generated code.
#pragma once

#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>

#include <string>
#include <vector>

class IDictionary {
  public:
    virtual ~IDictionary() {}
    virtual std::vector<int> pages(std::string word, std::vector<double> weights) = 0;
};

class DictionaryProvided : public ProvidedServicePort, public IDictionary {
  public:
    explicit DictionaryProvided(IDictionary* component) : component_(component) { setup(); }
    std::vector<int> pages(std::string word, std::vector<double> weights) override {
        return (*pages_)(word, weights);
    }

  private:
    void setup() {
        Method* method = makeProvidedMethod(&IDictionary::pages, component_, "pages");
        pages_ = reinterpret_cast<ProvidedMethod<std::vector<int>>*>(method);
        addMethod("pages", method);
    }
    IDictionary* component_;
    ProvidedMethod<std::vector<int>>* pages_;
};

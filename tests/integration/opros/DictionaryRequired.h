// SPDX-License-Identifier: Apache-2.0
// The service that TalkerComp requires, in the style of generated code.
#pragma once

#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include <string>
#include <vector>

class DictionaryRequired : public RequiredServicePort {
  public:
    DictionaryRequired() {
        pages_ = reinterpret_cast<PagesType*>(add(makeRequiredMethod(&DictionaryRequired::pages, "pages")));
    }
    std::vector<int> pages(std::string word, std::vector<double> weights) { return (*pages_)(word, weights); }

  private:
    typedef RequiredMethod<std::vector<int>> PagesType;
    Method* add(Method* method) {
        addMethod(method->getName(), method);
        return method;
    }
    PagesType* pages_;
};

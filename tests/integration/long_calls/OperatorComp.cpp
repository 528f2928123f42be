// SPDX-License-Identifier: Apache-2.0
// Uses a crane.
#include "operator.h"
#include "tests/integration/opros/simple_component.h"

#include <ServiceUtils.h>

/// In the style of generated code.
class CraneRequired : public RequiredServicePort {
  public:
    CraneRequired() {
        lift_ = reinterpret_cast<RequiredMethod<int>*>(add(makeRequiredMethod(&CraneRequired::lift, "lift")));
        lower_ = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&CraneRequired::lower, "lower", METHOD_NONBLOCKING)));
    }
    int lift(int steps) { return (*lift_)(steps); }
    void lower(int steps) { (*lower_)(steps); }

  private:
    Method* add(Method* method) {
        addMethod(method->getName(), method);
        return method;
    }
    RequiredMethod<int>* lift_;
    RequiredMethod<void>* lower_;
};

class OperatorComp : public SimpleComponent {
  public:
    OperatorComp() { addPort("crane", crane_); }

  protected:
    ReturnType onStart() override {
        operator_.start(getProperty("pipe"));
        return OPROS_SUCCESS;
    }
    ReturnType onStop() override {
        operator_.stop();
        return OPROS_SUCCESS;
    }

  private:
    std::string lift(int steps) {
        try {
            return std::to_string(crane_->lift(steps));
        } catch (MethodInvokeException& error) {
            return error.getId();
        }
    }
    CraneRequired* crane_ = new CraneRequired; // the component deletes its service ports
    Operator operator_{[this](int steps) { return lift(steps); },
                       [this](int steps) { crane_->lower(steps); }};
};

extern "C" {
Component* getComponent() { return new OperatorComp; }
void releaseComponent(Component* component) { delete component; }
}

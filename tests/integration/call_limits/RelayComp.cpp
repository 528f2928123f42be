// SPDX-License-Identifier: Apache-2.0
// One end of a relay.
#include "relay.h"
#include "tests/integration/opros/simple_component.h"

#include <ServiceUtils.h>

/// In the style of generated code.
class RelayRequired : public RequiredServicePort {
  public:
    RelayRequired() {
        echo_ =
            reinterpret_cast<RequiredMethod<Bytes>*>(add(makeRequiredMethod(&RelayRequired::echo, "echo")));
        deep_ = reinterpret_cast<RequiredMethod<int>*>(add(makeRequiredMethod(&RelayRequired::deep, "deep")));
        note_ = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RelayRequired::note, "note", METHOD_NONBLOCKING)));
    }
    Bytes echo(Bytes bytes) { return (*echo_)(bytes); }
    int deep(int depth) { return (*deep_)(depth); }
    void note(int number) { (*note_)(number); }

  private:
    Method* add(Method* method) {
        addMethod(method->getName(), method);
        return method;
    }
    RequiredMethod<Bytes>* echo_;
    RequiredMethod<int>* deep_;
    RequiredMethod<void>* note_;
};

/// Makes a call, and throws its failure as a text.
template <class Call>
auto call(Call&& make) {
    try {
        return make();
    } catch (MethodInvokeException& error) {
        throw std::string(error.what());
    }
}

class RelayComp : public SimpleComponent {
  public:
    RelayComp() {
        addPort("onward", onward_);
        auto* port = new ProvidedServicePort; // the component deletes its service ports
        port->addMethod("echo", makeProvidedMethod(&RelayComp::echo, this, "echo"));
        port->addMethod("deep", makeProvidedMethod(&RelayComp::deep, this, "deep"));
        port->addMethod("note", makeProvidedMethod(&RelayComp::note, this, "note"));
        addPort("relay", port);
    }
    Bytes echo(Bytes bytes) { return bytes; }
    int deep(int depth) { return end_.deep(depth); }
    void note(int number) { end_.note(number); }

  protected:
    ReturnType onStart() override {
        end_.start(getProperty("work"));
        return OPROS_SUCCESS;
    }
    ReturnType onStop() override {
        end_.stop();
        return OPROS_SUCCESS;
    }

  private:
    RelayRequired* onward_ = new RelayRequired;
    RelayEnd end_{{[this](const Bytes& bytes) { return call([&] { return onward_->echo(bytes); }); },
                   [this](int depth) { return call([&] { return onward_->deep(depth); }); },
                   [this](int number) { call([&] { onward_->note(number); }); }}};
};

extern "C" {
Component* getComponent() { return new RelayComp; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// The other end of the bridge: an event-driven OPRoS component that sends each message back.
#include <OPRoSInclude.h>

#include <memory>
#include <vector>

class InterfaceTypesMirror : public Component {
  public:
    ReturnType onExecute() override {
        while (const std::unique_ptr<opros_any> any{ping_.pop()}) pong_.push(*ping_.getContentPointer(*any));
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override {
        addPort("ping", &ping_);
        addPort("pong", &pong_);
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    InputDataPort<std::vector<unsigned char>> ping_{OPROS_FIFO, 16};
    OutputDataPort<std::vector<unsigned char>> pong_;
};

extern "C" {
Component* getComponent() { return new InterfaceTypesMirror; }
void releaseComponent(Component* component) { delete component; }
}

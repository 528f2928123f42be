// SPDX-License-Identifier: Apache-2.0
// The asking side of the bridge's measurement, an OPRoS component.
#include <OPRoSInclude.h>

#include "apps/bench/tandem/bridge/ping.hpp"

#include <memory>

using namespace tandem::bench;

class BenchPing : public Component {
  public:
    BenchPing() {
        addPort("ask", &ask_);
        addPort("answer", &answer_);
    }

    ReturnType onExecute() override {
        asker_->ask_for_a_slice(*this);
        return OPROS_SUCCESS;
    }

    void send(const PingMessage& message) {
        buffer_.assign(message.begin(), message.end());
        ask_.push(buffer_);
    }
    bool receive(PingMessage& message) {
        const std::unique_ptr<opros_any> any(answer_.pop());
        if (!any) return false;
        const auto* values = answer_.getContentPointer(*any);
        if (values == nullptr || values->size() != message.size()) return false;
        std::copy(values->begin(), values->end(), message.begin());
        return true;
    }

  protected:
    ReturnType onInitialize() override {
        Clock::calibrate();
        asker_ =
            std::make_unique<Asker>(getProperty("file"), getProperty("direction") == "opros-to-rtm",
                                    std::stoul(getProperty("samples")), std::stod(getProperty("seconds")));
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    OutputDataPort<std::vector<double>> ask_;
    InputDataPort<std::vector<double>> answer_{OPROS_FIFO, 16};
    std::vector<double> buffer_;
    std::unique_ptr<Asker> asker_;
};

extern "C" {
Component* getComponent() { return new BenchPing; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// The OPRoS component of the bridge's measurement: sends pings and times the answers (ping.hpp).
#include <OPRoSInclude.h>

#include "apps/bench/tandem/bridge/ping.hpp"

#include <memory>

using namespace tandem::bench;

class BenchPing : public Component {
  public:
    BenchPing() {
        addPort("ping", &ping_);
        addPort("pong", &pong_);
    }

    // Polls for the most of each period: a latency, not the period, is to be measured.
    ReturnType onExecute() override {
        client_->ping_for_a_slice(*this);
        return OPROS_SUCCESS;
    }

    // The Port that ping.hpp asks for.
    void send(const PingMessage& message) {
        buffer_.assign(message.begin(), message.end());
        ping_.push(buffer_);
    }
    bool receive(PingMessage& message) {
        // Popped by value and read in place: no copy of the vector.
        const std::unique_ptr<opros_any> any(pong_.pop());
        if (!any) return false;
        const auto* values = pong_.getContentPointer(*any);
        if (values == nullptr || values->size() != message.size()) return false;
        std::copy(values->begin(), values->end(), message.begin());
        return true;
    }

  protected:
    // The bench sets the properties in the application profile.
    ReturnType onInitialize() override {
        Clock::calibrate();
        client_ =
            std::make_unique<PingClient>(getProperty("file"), getProperty("direction") == "opros-to-rtm",
                                         std::stoul(getProperty("samples")),
                                         std::stod(getProperty("seconds")), getProperty("cold") == "yes");
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    OutputDataPort<std::vector<double>> ping_;
    InputDataPort<std::vector<double>> pong_{OPROS_FIFO, 16};
    std::vector<double> buffer_; // keeps its capacity: no allocation per message
    std::unique_ptr<PingClient> client_;
};

extern "C" {
Component* getComponent() { return new BenchPing; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// The OPRoS component of the calls across the bridge. It answers calls. With the property `file` it also
// makes and times them.
#include <OPRoSInclude.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>
#include <ServiceUtils.h>

#include "apps/bench/tandem/bridge/call_timer.hpp"

#include <memory>
#include <optional>

using namespace tandem::bench;

namespace {

/// The interface of the service.
class IAdder {
  public:
    virtual ~IAdder() {}
    virtual double add(double a, double b) = 0;
};

// The two classes below are written as OPRoS's generators write service ports.
class AdderProvided : public ProvidedServicePort {
  public:
    explicit AdderProvided(IAdder* owner) {
        addMethod("add", makeProvidedMethod(&IAdder::add, owner, "add"));
    }
};

class AdderRequired : public RequiredServicePort {
  public:
    AdderRequired() {
        Method* method = makeRequiredMethod(&AdderRequired::add, "add");
        addMethod("add", method);
        add_ = reinterpret_cast<RequiredMethod<double>*>(method);
    }
    double add(double a, double b) { return (*add_)(a, b); }

  private:
    RequiredMethod<double>* add_;
};

} // namespace

class BenchCallComp : public Component, public IAdder {
  public:
    BenchCallComp() {
        addPort("required", required_);
        addPort("provided", new AdderProvided(this));
    }

    ReturnType onExecute() override {
        if (!timer_) return OPROS_SUCCESS;
        timer_->call_for_a_slice([this](double a, double b) -> std::optional<double> {
            try {
                return required_->add(a, b);
            } catch (MethodInvokeException&) { // until the peer is connected
                return std::nullopt;
            }
        });
        return OPROS_SUCCESS;
    }

    /// [worker of the proxy]
    double add(double a, double b) override {
        if (floor_) floor_->note_call();
        return a + b;
    }

  protected:
    // The bench sets the properties in the application profile.
    ReturnType onInitialize() override {
        Clock::calibrate();
        const auto settings = CallSettings::from([this](const char* name) { return getProperty(name); });
        if (!settings.file.empty())
            timer_ = std::make_unique<CallTimer>(settings);
        else if (!settings.floor.empty())
            floor_ = std::make_unique<FloorAdder>(settings);
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    AdderRequired* required_ = new AdderRequired; // the component deletes its service ports
    std::unique_ptr<CallTimer> timer_;
    std::unique_ptr<FloorAdder> floor_;
};

extern "C" {
Component* getComponent() { return new BenchCallComp; }
void releaseComponent(Component* component) { delete component; }
}

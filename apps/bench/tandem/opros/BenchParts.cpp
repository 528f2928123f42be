// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/opros/BenchParts.hpp"

#include <Component.h>
#include <EventData.h>
#include <InputDataPort.h>
#include <InputEventPort.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include <atomic>
#include <cstdlib>
#include <ctime>

namespace {

class IDoubler {
  public:
    virtual ~IDoubler() {}
    virtual double twice(double value) = 0;
};

// In the style of generated service code.
class DoublerProvided : public ProvidedServicePort, public IDoubler {
  public:
    explicit DoublerProvided(IDoubler* owner) {
        Method* method = makeProvidedMethod(&IDoubler::twice, owner, "twice");
        addMethod("twice", method);
        twice_ = reinterpret_cast<ProvidedMethod<double>*>(method);
    }
    virtual double twice(double value) { return (*twice_)(value); }

  private:
    ProvidedMethod<double>* twice_;
};

class DoublerRequired : public RequiredServicePort {
  public:
    DoublerRequired() {
        Method* method = makeRequiredMethod(&DoublerRequired::twice, "twice");
        addMethod("twice", method);
        twice_ = reinterpret_cast<RequiredMethod<double>*>(method);
    }
    double twice(double value) { return (*twice_)(value); }

  private:
    RequiredMethod<double>* twice_;
};

std::int64_t now_ns() {
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000000000LL + now.tv_nsec;
}

class Parts : public Component, public BenchParts, public IDoubler {
  public:
    Parts() : required_(new DoublerRequired) {
        addPort("out", &out_);
        addPort("in", &in_);
        addPort("arrays_out", &arrays_out_);
        addPort("arrays_in", &arrays_in_);
        addPort("news_out", &news_out_);
        addPort("news_in", &news_in_);
        addPort("doubler", new DoublerProvided(this));
        addPort("needed", required_);
        news_in_.setOwner(this);
        event_.setId("value");
    }

    virtual void push(double value) { out_.push(value); }
    virtual void push(const std::vector<double>& values) { arrays_out_.push(values); }
    virtual double call(double value) { return required_->twice(value); }
    virtual double twice(double value) { return 2 * value; }
    virtual void send_event(double value) {
        event_.setContentData(value);
        news_out_.push(&event_);
    }
    virtual double heard() const { return heard_.load(std::memory_order_acquire); }
    virtual double pop() {
        opros_any* data = in_.pop();
        if (!data) return -1;
        const double value = in_.getContent(*data);
        delete data;
        return value;
    }
    virtual const tandem::bench::TickRecord& ticks() const { return ticks_; }

  protected:
    virtual ReturnType onInitialize() {
        ticks_.prepare(std::atoll(getProperty("period_ns").c_str()),
                       static_cast<std::size_t>(std::atoll(getProperty("samples").c_str())),
                       std::atoll(getProperty("origin_ns").c_str()));
        return OPROS_SUCCESS;
    }
    virtual ReturnType onStart() { return OPROS_SUCCESS; }
    virtual ReturnType onStop() { return OPROS_SUCCESS; }
    virtual ReturnType onDestroy() { return OPROS_SUCCESS; }

  public:
    virtual ReturnType onEvent(Event* event) {
        heard_.store(*static_cast<EventData<double>*>(event)->getContentData(), std::memory_order_release);
        return OPROS_SUCCESS;
    }
    virtual ReturnType onExecute() {
        ticks_.tick(now_ns());
        return OPROS_SUCCESS;
    }

  private:
    OutputDataPort<double> out_;
    InputDataPort<double> in_;
    OutputDataPort<std::vector<double>> arrays_out_;
    InputDataPort<std::vector<double>> arrays_in_;
    OutputEventPort<double> news_out_;
    InputEventPort<double> news_in_;
    DoublerRequired* required_;
    EventData<double> event_;
    std::atomic<double> heard_{0};
    tandem::bench::TickRecord ticks_;
};

} // namespace

extern "C" Component* getComponent() { return new Parts; }
extern "C" void releaseComponent(Component* component) { delete component; }

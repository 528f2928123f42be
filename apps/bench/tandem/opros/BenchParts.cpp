// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/opros/BenchParts.hpp"

#include "apps/bench/tandem/opros/doubler.hpp"

#include <Component.h>
#include <EventData.h>
#include <InputDataPort.h>
#include <InputEventPort.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>

#include <atomic>
#include <cstdlib>
#include <ctime>

using tandem::bench::DoublerProvided;
using tandem::bench::DoublerRequired;

namespace {

std::int64_t monotonic_ns() {
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000000000LL + now.tv_nsec;
}

/// Connected to another instance, or (BenchTick.xml) alone and periodic.
class Parts : public Component, public BenchParts, public tandem::bench::IDoubler {
  public:
    Parts() : required_(new DoublerRequired) {
        addPort("out", &out_);
        addPort("in", &in_);
        addPort("arrays_out", &arrays_out_);
        addPort("arrays_in", &arrays_in_);
        addPort("events_out", &events_out_);
        addPort("events_in", &events_in_);
        // Service ports are never deleted, as in generated components; the other ports are members.
        addPort("doubler", new DoublerProvided(this));
        addPort("doubler_required", required_);
        events_in_.setOwner(this);
        event_.setId("value");
    }

    void push(double value) override { out_.push(value); }
    void push(const std::vector<double>& values) override { arrays_out_.push(values); }
    double call(double value) override { return required_->twice(value); }
    double twice(double value) override { return 2 * value; }
    void send_event(double value) override {
        event_.setContentData(value);
        events_out_.push(&event_);
    }
    double last_event() const override { return last_event_.load(std::memory_order_acquire); }
    double pop_value() override {
        opros_any* data = in_.pop(); // the caller owns it
        if (!data) return -1;
        const double value = in_.getContent(*data);
        delete data;
        return value;
    }
    const tandem::bench::TickRecord& tick_record() const override { return tick_record_; }

  protected:
    // The bench sets these properties in the application profile.
    ReturnType onInitialize() override {
        tick_record_.prepare(std::atoll(getProperty("period_ns").c_str()),
                             static_cast<std::size_t>(std::atoll(getProperty("samples").c_str())),
                             std::atoll(getProperty("origin_ns").c_str()));
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  public:
    /// [worker of the engine]
    ReturnType onEvent(Event* event) override {
        last_event_.store(*static_cast<EventData<double>*>(event)->getContentData(),
                          std::memory_order_release);
        return OPROS_SUCCESS;
    }
    /// [tick-thread] Only BenchTick.xml makes it periodic.
    ReturnType onExecute() override {
        tick_record_.record_tick(monotonic_ns());
        return OPROS_SUCCESS;
    }

  private:
    OutputDataPort<double> out_;
    InputDataPort<double> in_;
    OutputDataPort<std::vector<double>> arrays_out_;
    InputDataPort<std::vector<double>> arrays_in_;
    OutputEventPort<double> events_out_;
    InputEventPort<double> events_in_;
    DoublerRequired* required_;
    EventData<double> event_;
    // Written by the engine's worker, polled by the bench.
    std::atomic<double> last_event_{0};
    tandem::bench::TickRecord tick_record_;
};

} // namespace

extern "C" Component* getComponent() { return new Parts; }
extern "C" void releaseComponent(Component* component) { delete component; }

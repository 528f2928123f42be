// SPDX-License-Identifier: Apache-2.0
// The OPRoS component whose instructions are counted: it performs one operation per cycle, between two marks.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "apps/bench/path/path_mark.hpp"
#include "apps/bench/tandem/opros/doubler.hpp"

#include <algorithm>
#include <array>
#include <memory>

using tandem::bench::DoublerProvided;
using tandem::bench::DoublerRequired;
using tandem::bench::mark;
using tandem::bench::PathMark;

/// Its property `role` selects what it does: send, receive, call, or only answer calls.
class BenchPath : public Component, public tandem::bench::IDoubler {
  public:
    BenchPath() {
        addPort("out", &out_);
        addPort("in", &in_);
        addPort("required", required_);
        addPort("provided", new DoublerProvided(this));
    }

    ReturnType onExecute() override {
        if (role_ == "send") send();
        if (role_ == "receive") receive();
        if (role_ == "call") call();
        return OPROS_SUCCESS;
    }

    /// [worker of the proxy, or the caller's thread]
    double twice(double value) override {
        mark(PathMark::served);
        return 2 * value;
    }

  protected:
    ReturnType onInitialize() override {
        role_ = getProperty("role");
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    void send() {
        sent_[0] += 1;
        mark(PathMark::send_begin);
        out_.push(sent_);
        mark(PathMark::send_end);
    }
    void receive() {
        mark(PathMark::receive_begin);
        const bool received = pop_values();
        mark(received ? PathMark::receive_end : PathMark::nothing);
    }
    /// Receives as components do: pops, reads in place, deletes. Returns false if there is no newer message.
    bool pop_values() {
        const std::unique_ptr<opros_any> any(in_.pop());
        if (!any) return false;
        const std::vector<double>* values = in_.getContentPointer(*any);
        if (values == nullptr || values->size() != received_.size() || (*values)[0] <= received_[0])
            return false;
        std::copy(values->begin(), values->end(), received_.begin());
        return true;
    }
    /// A call fails with an exception until the peer is connected.
    void call() {
        argument_ += 1;
        PathMark end = PathMark::call_end;
        mark(PathMark::call_begin);
        try {
            if (required_->twice(argument_) != 2 * argument_) end = PathMark::nothing;
        } catch (MethodInvokeException&) {
            end = PathMark::nothing;
        }
        mark(end);
    }

    std::string role_;
    std::vector<double> sent_ = std::vector<double>(6);
    std::array<double, 6> received_{};
    double argument_ = 0;
    OutputDataPort<std::vector<double>> out_;
    InputDataPort<std::vector<double>> in_{OPROS_FIFO, 16};
    DoublerRequired* required_ = new DoublerRequired; // the component deletes its service ports
};

extern "C" {
Component* getComponent() { return new BenchPath; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// Sends data, events and calls as fast as its cycle allows, and counts what arrives.
#include "load_counts.h"

#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

class WorkerRequired : public RequiredServicePort {
  public:
    WorkerRequired() {
        Method* method = makeRequiredMethod(&WorkerRequired::work, "work");
        addMethod(method->getName(), method);
        work_ = reinterpret_cast<RequiredMethod<int>*>(method);
    }
    int work(int number) { return (*work_)(number); }

  private:
    RequiredMethod<int>* work_;
};

class IWorker {
  public:
    virtual ~IWorker() {}
    virtual int work(int number) = 0;
};

class WorkerProvided : public ProvidedServicePort {
  public:
    explicit WorkerProvided(IWorker* worker) {
        addMethod("work", makeProvidedMethod(&IWorker::work, worker, "work"));
    }
};

class LoadComp : public Component, public IWorker {
  public:
    LoadComp() {
        addPort("out", &out_);
        addPort("in", &in_);
        addPort("alarm", &alarm_);
        notice_.setOwner(this);
        addPort("notice", &notice_);
        addPort("worker", worker_);
        addPort("work", new WorkerProvided(this)); // the component deletes its service ports
    }
    int work(int number) override { return do_work(number); }

    ReturnType onExecute() override {
        for (int i = 0; i < 10; ++i) {
            ++number_;
            std::vector<int> message(MessagePattern::length_of(number_), number_);
            message[0] = life_;
            out_.push(message);
            ++counts_.sent;
        }
        EventData<double> event;
        event.setId("hot");
        event.setContentData(number_);
        alarm_.push(&event);
        ++counts_.events_sent;
        while (const std::unique_ptr<opros_any> message{in_.pop()}) {
            const auto& numbers = *in_.getContentPointer(*message);
            if (!pattern_.is_right(numbers, numbers.size())) ++counts_.wrong;
            if (!numbers.empty()) counts_.count_message(static_cast<std::uint64_t>(numbers[0]));
        }
        return OPROS_SUCCESS;
    }
    ReturnType onEvent(Event*) override {
        ++counts_.events_received;
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override {
        life_ = static_cast<int>(++counts_.lives);
        counts_.first_received_ns = 0;
        counts_.ready_ns = load_clock_ns();
        return OPROS_SUCCESS;
    }
    ReturnType onStart() override {
        calls_.emplace(counts_, [this](int number) { return call(number); });
        return OPROS_SUCCESS;
    }
    ReturnType onStop() override {
        calls_.reset();
        return OPROS_SUCCESS;
    }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    CallEnd call(int number) {
        try {
            if (worker_->work(number) != number + 1) ++counts_.wrong;
            return CallEnd::ok;
        } catch (MethodInvokeException& error) {
            return call_end_of(error.getId());
        }
    }

    SideCounts& counts_ = load_counts().opros;
    MessagePattern pattern_;
    int life_ = 0, number_ = 0;
    OutputDataPort<std::vector<int>> out_;
    InputDataPort<std::vector<int>> in_;
    OutputEventPort<double> alarm_;
    InputEventPort<double> notice_;
    WorkerRequired* worker_ = new WorkerRequired;
    std::optional<CallLoad> calls_;
};

extern "C" {
Component* getComponent() { return new LoadComp; }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// Sends three values of each kind, receives them back on an input port of each policy, and prints a line for each cell:
// kind, direction, policy, ok or what came.
#include "../opros/simple_component.h"
#include "MatrixTypes.h"

#include <iostream>
#include <memory>
#include <syncstream>
#include <vector>

namespace {

constexpr int values = 3;
constexpr struct {
    const char* name;
    DataPortPolicy policy;
} policies[] = {{"fifo", OPROS_FIFO}, {"last", OPROS_LAST}, {"lifo", OPROS_LIFO}, {"ufifo", OPROS_UFIFO}};

// The value number i of each kind.
#define KIND(name, idl, opros, value)                                                                        \
    opros value_of_##name(int i) { return value; }
#include "kinds.inc"
#undef KIND

class AnyKind {
  public:
    virtual ~AnyKind() = default;
    virtual void send() = 0;
    /// True when the cells of this kind have been printed.
    virtual bool receive() = 0;
};

/// The ports of one kind. The port with the policy LAST is read when all values have arrived, the others at
/// once.
template <class T>
class Kind : public AnyKind {
  public:
    Kind(Component& component, const std::string& name, T (*value)(int)) : name_(name), value_(value) {
        component.addPort(name, &output_);
        for (int i = 0; i < 4; ++i) component.addPort(name + "_" + policies[i].name, &inputs_[i]);
    }
    void send() override {
        for (int i = 1; i <= values; ++i) {
            T value = value_(i);
            sent_ = output_.push(value) == OPROS_SUCCESS && sent_;
        }
    }
    bool receive() override {
        if (printed_) return true;
        take(0);
        if (count_[0] < values) return false;
        for (int i = 1; i < 4; ++i) take(i);
        if (count_[2] < values || count_[3] < values) return false;
        printed_ = true;
        bool complete = sent_;
        for (int i = 0; i < values; ++i) complete = complete && matrix::same(received_[0][i], value_(i + 1));
        print("to RTM", "push", complete);
        for (int i = 0; i < 4; ++i) print("to OPRoS", policies[i].name, is_right(i));
        return true;
    }

  private:
    void take(int policy) {
        while (const std::unique_ptr<opros_any> value{inputs_[policy].pop()})
            if (count_[policy]++ < values)
                received_[policy][count_[policy] - 1] = inputs_[policy].getContent(*value);
    }
    bool is_right(int policy) const {
        const auto& all = received_[policy];
        if (policies[policy].policy == OPROS_LAST)
            return count_[policy] == 1 && matrix::same(all[0], value_(values));
        const bool reversed = policies[policy].policy == OPROS_LIFO;
        if (count_[policy] != values) return false;
        for (int i = 0; i < values; ++i)
            if (!matrix::same(all[i], value_(reversed ? values - i : i + 1))) return false;
        return true;
    }
    void print(const char* direction, const char* policy, bool ok) const {
        std::osyncstream(std::cout) << "cell: " << name_ << ", " << direction << ", " << policy << ": "
                                    << (ok ? "ok" : "WRONG") << std::endl;
    }

    const std::string name_;
    T (*const value_)(int);
    OutputDataPort<T> output_;
    InputDataPort<T> inputs_[4] = {{OPROS_FIFO, 8}, {OPROS_LAST, 1}, {OPROS_LIFO, 8}, {OPROS_UFIFO, 8}};
    T received_[4][values] = {};
    int count_[4] = {}; ///< also of what is more than that
    bool sent_ = true, printed_ = false;
};

/// Asks the RTC for an any of each type, one after the other, and returns each.
class AnyRelay {
  public:
    explicit AnyRelay(Component& component) {
        component.addPort("AnyRequest", &request_);
        component.addPort("AnySent", &sent_);
        component.addPort("AnyReturned", &returned_);
    }
    void ask() { request_.push(number_); }
    void relay() {
        while (const std::unique_ptr<opros_any> value{sent_.pop()}) {
            matrix::Returned back;
            back.number = number_++;
            back.content = sent_.getContent(*value);
            returned_.push(back);
            ask();
        }
    }

  private:
    int number_ = 0;
    OutputDataPort<int> request_;
    InputDataPort<matrix::Anything> sent_{OPROS_FIFO, 8};
    OutputDataPort<matrix::Returned> returned_;
};

class MatrixComp : public SimpleComponent {
  public:
    MatrixComp() {
#define KIND(name, idl, opros, value)                                                                        \
    kinds_.push_back(std::unique_ptr<AnyKind>(new Kind<opros>(*this, #name, value_of_##name)));
#include "kinds.inc"
#undef KIND
    }

    ReturnType onExecute() override {
        if (cycle_++ == 0) {
            for (const auto& kind : kinds_) kind->send();
            anys_.ask();
        }
        anys_.relay();
        std::size_t done = 0;
        for (const auto& kind : kinds_) done += kind->receive() ? 1 : 0;
        if (done == kinds_.size() && !printed_)
            std::osyncstream(std::cout) << "all kinds received" << std::endl;
        printed_ = done == kinds_.size();
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onEvent(Event*) override { return OPROS_SUCCESS; }
    ReturnType onUpdated() override { return OPROS_SUCCESS; }
    ReturnType onPeriodChanged() override { return OPROS_SUCCESS; }

  private:
    AnyRelay anys_{*this};
    std::vector<std::unique_ptr<AnyKind>> kinds_;
    int cycle_ = 0;
    bool printed_ = false;
};

} // namespace

extern "C" {
Component* getComponent() { return new MatrixComp(); }
void releaseComponent(Component* component) { delete component; }
}

// SPDX-License-Identifier: Apache-2.0
// Sends three values of each kind, receives them back on an input port of each policy, and prints a line for each cell:
// kind, direction, policy, ok or what came.
#include "../opros/simple_component.h"
#include "MatrixTypes.h"

#include <deque>
#include <functional>
#include <iostream>
#include <memory>
#include <syncstream>

namespace {

constexpr int values = 3;
constexpr struct {
    const char* name;
    DataPortPolicy policy;
} policies[] = {{"fifo", OPROS_FIFO}, {"last", OPROS_LAST}, {"lifo", OPROS_LIFO}, {"ufifo", OPROS_UFIFO}};

/// The ports of one kind. The port of the policy LAST is read when all values are there, the others as they come.
template <class T>
class Kind {
  public:
    Kind(Component& component, const std::string& name, T (*value)(int)) : name_(name), value_(value) {
        component.addPort(name, &output_);
        for (int i = 0; i < 4; ++i) component.addPort(name + "_" + policies[i].name, &inputs_[i]);
    }
    void send() {
        for (int i = 1; i <= values; ++i) {
            T value = value_(i);
            sent_ = output_.push(value) == OPROS_SUCCESS && sent_;
        }
    }
    /// True when the cells of this kind have been printed.
    bool receive() {
        if (printed_) return true;
        take(0);
        if (received_[0].size() < values) return false;
        for (int i = 1; i < 4; ++i) take(i);
        if (received_[2].size() < values || received_[3].size() < values) return false;
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
            received_[policy].push_back(inputs_[policy].getContent(*value));
    }
    bool is_right(int policy) const {
        const auto& all = received_[policy];
        if (policies[policy].policy == OPROS_LAST)
            return all.size() == 1 && matrix::same(all[0], value_(values));
        const bool reversed = policies[policy].policy == OPROS_LIFO;
        if (all.size() != values) return false;
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
    std::deque<T> received_[4];
    bool sent_ = true, printed_ = false;
};

class MatrixComp : public SimpleComponent {
  public:
    MatrixComp(){
#define KIND(name, idl, opros, value)                                                                        \
    {                                                                                                        \
        auto kind = std::make_shared<Kind<opros>>(                                                           \
            *this, #name, +[](int i) -> opros { return value; });                                            \
        senders_.push_back([kind] { kind->send(); });                                                        \
        receivers_.push_back([kind] { return kind->receive(); });                                            \
    }
#include "kinds.inc"
#undef KIND
    }

    ReturnType onExecute() override {
        if (cycle_++ == 0)
            for (const auto& send : senders_) send();
        std::size_t done = 0;
        for (const auto& receive : receivers_) done += receive() ? 1 : 0;
        if (done == receivers_.size() && !printed_)
            std::osyncstream(std::cout) << "all kinds received" << std::endl;
        printed_ = done == receivers_.size();
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onEvent(Event*) override { return OPROS_SUCCESS; }
    ReturnType onUpdated() override { return OPROS_SUCCESS; }
    ReturnType onPeriodChanged() override { return OPROS_SUCCESS; }

  private:
    std::vector<std::function<void()>> senders_;
    std::vector<std::function<bool()>> receivers_;
    int cycle_ = 0;
    bool printed_ = false;
};

} // namespace

extern "C" {
Component* getComponent() { return new MatrixComp(); }
void releaseComponent(Component* component) { delete component; }
}

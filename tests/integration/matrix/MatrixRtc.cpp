// SPDX-License-Identifier: Apache-2.0
// Sends back what it receives, for each kind. Sends an any of each type and checks the answer.
#include "../rtm/register_rtc.hpp"
#include "tests/proxy/interceptor/anys_of_everything.hpp"

#include "KindsSkel.h"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>
#include <vector>

namespace {

struct AnyEcho {
    virtual ~AnyEcho() = default;
    virtual void execute() = 0;
};

template <class T>
struct Echo : AnyEcho {
    explicit Echo(const std::string& name) : in(name.c_str(), value), out((name + "Back").c_str(), value) {}
    void execute() override {
        while (in.isNew())
            if (in.read()) out.write();
    }
    T value;
    RTC::InPort<T> in;
    RTC::OutPort<T> out;
};

/// Answers requests for an any by its number. Prints a line for each any that comes back, and one for all of
/// them.
class AnyCells {
  public:
    void add_to(RTC::DataFlowComponentBase& component) {
        component.addInPort("AnyRequest", request_in_);
        component.addOutPort("AnySent", sent_out_);
        component.addInPort("AnyReturned", returned_in_);
    }
    void execute() {
        while (returned_in_.isNew())
            if (returned_in_.read()) check(static_cast<std::size_t>(returned_.number));
        while (request_in_.isNew())
            if (request_in_.read()) send(static_cast<std::size_t>(request_.content));
    }

  private:
    void send(std::size_t number) {
        if (number > anys_.size()) return;
        // After the last one, one that cannot cross.
        sent_.content = number < anys_.size() ? anys_[number].any : tandem::test::any_of(TestTypes::Node());
        const bool sent = sent_out_.write();
        if (number == anys_.size())
            std::osyncstream(std::cout) << "cells of anys: " << passed_ << " of " << anys_.size()
                                        << " ok, recursive " << (sent ? "sent" : "refused") << std::endl;
    }
    void check(std::size_t number) {
        if (number >= anys_.size()) return;
        const bool same = tandem::test::is_same_any(anys_[number].any, returned_.content);
        passed_ += same ? 1 : 0;
        std::osyncstream(std::cout) << "cell: any of " << anys_[number].name
                                    << ", there and back: " << (same ? "ok" : "WRONG") << std::endl;
    }

    const std::vector<tandem::test::NamedAny> anys_ = tandem::test::anys_of_everything();
    std::size_t passed_ = 0;
    Matrix::Int32 request_;
    Matrix::Anything sent_;
    Matrix::Returned_t returned_;
    RTC::InPort<Matrix::Int32> request_in_{"AnyRequest", request_};
    RTC::OutPort<Matrix::Anything> sent_out_{"AnySent", sent_};
    RTC::InPort<Matrix::Returned_t> returned_in_{"AnyReturned", returned_};
};

class MatrixRtc : public RTC::DataFlowComponentBase {
  public:
    explicit MatrixRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
#define KIND(name, idl, opros, value) add<Matrix::name>(#name);
#include "kinds.inc"
#undef KIND
        anys_.add_to(*this);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        for (const auto& echo : echoes_) echo->execute();
        anys_.execute();
        return RTC::RTC_OK;
    }

  private:
    template <class T>
    void add(const char* name) {
        auto* echo = new Echo<T>(name);
        echoes_.push_back(std::unique_ptr<AnyEcho>(echo));
        addInPort(name, echo->in);
        addOutPort((std::string(name) + "Back").c_str(), echo->out);
    }
    std::vector<std::unique_ptr<AnyEcho>> echoes_;
    AnyCells anys_;
};

} // namespace

extern "C" void MatrixRtcInit(RTC::Manager* manager) { register_rtc<MatrixRtc>(manager, "MatrixRtc"); }

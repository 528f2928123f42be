// SPDX-License-Identifier: Apache-2.0
// Sends back what it receives, of each kind.
#include "../rtm/register_rtc.hpp"
#include "KindsSkel.h"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

template <class T>
struct Echo {
    explicit Echo(const std::string& name) : in(name.c_str(), value), out((name + "Back").c_str(), value) {}
    void execute() {
        while (in.isNew())
            if (in.read()) out.write();
    }
    T value;
    RTC::InPort<T> in;
    RTC::OutPort<T> out;
};

class MatrixRtc : public RTC::DataFlowComponentBase {
  public:
    explicit MatrixRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
#define KIND(name, idl, opros, value) add<Matrix::name>(#name);
#include "kinds.inc"
#undef KIND
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        for (const auto& execute : echoes_) execute();
        return RTC::RTC_OK;
    }

  private:
    template <class T>
    void add(const char* name) {
        auto echo = std::make_shared<Echo<T>>(name);
        addInPort(name, echo->in);
        addOutPort((std::string(name) + "Back").c_str(), echo->out);
        echoes_.push_back([echo] { echo->execute(); });
    }
    std::vector<std::function<void()>> echoes_;
};

} // namespace

extern "C" void MatrixRtcInit(RTC::Manager* manager) { register_rtc<MatrixRtc>(manager, "MatrixRtc"); }

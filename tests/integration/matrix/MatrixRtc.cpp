// SPDX-License-Identifier: Apache-2.0
// Sends back what it receives, of each kind.
#include "../rtm/register_rtc.hpp"
#include "KindsSkel.h"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

#include <memory>
#include <string>
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
        for (const auto& echo : echoes_) echo->execute();
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
};

} // namespace

extern "C" void MatrixRtcInit(RTC::Manager* manager) { register_rtc<MatrixRtc>(manager, "MatrixRtc"); }

// SPDX-License-Identifier: Apache-2.0
// The answering side of the bridge's measurement, an RT-Component.
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include "apps/bench/tandem/bridge/ping.hpp"

#include <algorithm>

using namespace tandem::bench;

class BenchPong : public RTC::DataFlowComponentBase {
  public:
    explicit BenchPong(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), askIn_("ask", ask_), answerOut_("answer", answer_) {}

    RTC::ReturnCode_t onInitialize() override {
        Clock::calibrate();
        addInPort("ask", askIn_);
        addOutPort("answer", answerOut_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        answer_for_a_slice(*this);
        return RTC::RTC_OK;
    }

    void send(const PingMessage& message) {
        answer_.data.length(message.size());
        std::copy(message.begin(), message.end(), answer_.data.get_buffer());
        answerOut_.write();
    }
    bool receive(PingMessage& message) {
        if (!askIn_.isNew()) return false;
        askIn_.read();
        if (ask_.data.length() != message.size()) return false;
        std::copy_n(ask_.data.get_buffer(), message.size(), message.begin());
        return true;
    }

  private:
    RTC::TimedDoubleSeq ask_, answer_;
    RTC::InPort<RTC::TimedDoubleSeq> askIn_;
    RTC::OutPort<RTC::TimedDoubleSeq> answerOut_;
};

extern "C" void BenchPongInit(RTC::Manager* manager) {
    const char* const spec[] = {"implementation_id",
                                "BenchPong",
                                "type_name",
                                "BenchPong",
                                "description",
                                "answers tandem-bench",
                                "version",
                                "1.0",
                                "vendor",
                                "Tandem",
                                "category",
                                "bench",
                                "activity_type",
                                "PERIODIC",
                                "kind",
                                "DataFlowComponent",
                                "max_instance",
                                "0",
                                "language",
                                "C++",
                                "lang_type",
                                "compile",
                                ""};
    coil::Properties profile(spec);
    manager->registerFactory(profile, RTC::Create<BenchPong>, RTC::Delete<BenchPong>);
}

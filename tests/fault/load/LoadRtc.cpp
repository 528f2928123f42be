// SPDX-License-Identifier: Apache-2.0
// Sends data, events and calls as fast as its cycle allows, and counts what arrives.
#include "../../integration/rtm/register_rtc.hpp"
#include "LoadSkel.h"
#include "load_counts.h"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <optional>

namespace {

class WorkerService : public POA_TestLoad::Worker, public virtual PortableServer::RefCountServantBase {
  public:
    CORBA::Long work(CORBA::Long number) override { return do_work(number); }
};

} // namespace

class LoadRtc : public RTC::DataFlowComponentBase {
  public:
    explicit LoadRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), numbersIn_("numbers", received_), backOut_("back", sent_),
          raisedIn_("raised", raised_), answerOut_("answer", answer_), provided_("worker"),
          required_("work") {}

    RTC::ReturnCode_t onInitialize() override {
        life_ = static_cast<int>(++counts_.lives);
        counts_.first_received_ns = 0;
        counts_.ready_ns = load_clock_ns();
        addInPort("numbers", numbersIn_);
        addOutPort("back", backOut_);
        addInPort("raised", raisedIn_);
        addOutPort("answer", answerOut_);
        provided_.registerProvider("worker", "TestLoad::Worker", service_);
        addPort(provided_);
        required_.registerConsumer("work", "TestLoad::Worker", worker_);
        addPort(required_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        calls_.emplace(counts_, [this](int number) { return call(number); });
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        calls_.reset();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        for (int i = 0; i < 10; ++i) {
            sent_.data.length(static_cast<CORBA::ULong>(MessagePattern::length_of(++number_)));
            for (CORBA::ULong at = 0; at < sent_.data.length(); ++at) sent_.data[at] = number_;
            sent_.data[0] = life_;
            backOut_.write();
            ++counts_.sent;
        }
        answer_.id = CORBA::string_dup("cold");
        answer_.level = number_;
        answerOut_.write();
        ++counts_.events_sent;
        while (numbersIn_.isNew()) {
            numbersIn_.read();
            if (!pattern_.is_right(received_.data, received_.data.length())) ++counts_.wrong;
            if (received_.data.length() != 0)
                counts_.count_message(static_cast<std::uint64_t>(received_.data[0]));
        }
        while (raisedIn_.isNew()) {
            raisedIn_.read();
            ++counts_.events_received;
        }
        return RTC::RTC_OK;
    }

  private:
    CallEnd call(int number) {
        try {
            if (worker_->work(number) != number + 1) ++counts_.wrong;
            return CallEnd::ok;
        } catch (const CORBA::SystemException& error) {
            return call_end_of(error._name());
        }
    }

    SideCounts& counts_ = load_counts().rtm;
    MessagePattern pattern_;
    int life_ = 0, number_ = 0;
    RTC::TimedLongSeq received_, sent_;
    RTC::InPort<RTC::TimedLongSeq> numbersIn_;
    RTC::OutPort<RTC::TimedLongSeq> backOut_;
    TestLoad::TimedAlarm raised_, answer_;
    RTC::InPort<TestLoad::TimedAlarm> raisedIn_;
    RTC::OutPort<TestLoad::TimedAlarm> answerOut_;
    WorkerService service_;
    RTC::CorbaPort provided_, required_;
    RTC::CorbaConsumer<TestLoad::Worker> worker_;
    std::optional<CallLoad> calls_;
};

extern "C" void LoadRtcInit(RTC::Manager* manager) { register_rtc<LoadRtc>(manager, "LoadRtc"); }

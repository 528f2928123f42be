// SPDX-License-Identifier: Apache-2.0
// One end of a relay.
#include "RelaySkel.h"
#include "RelayStub.h"
#include "relay.h"
#include "tests/integration/rtm/register_rtc.hpp"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>

#include <algorithm>

namespace {

class RelayService : public POA_TestRelay::Relay, public virtual PortableServer::RefCountServantBase {
  public:
    explicit RelayService(RelayEnd& end) : end_(end) {}
    TestRelay::Bytes* echo(const TestRelay::Bytes& data) override { return new TestRelay::Bytes(data); }
    CORBA::Long deep(CORBA::Long depth) override { return end_.deep(depth); }
    void note(CORBA::Long number) override { end_.note(number); }

  private:
    RelayEnd& end_;
};

/// Makes a call, and throws its failure as a text.
template <class Call>
auto call(Call&& make) {
    try {
        return make();
    } catch (const CORBA::SystemException& error) {
        throw std::string(error._name());
    }
}

} // namespace

class RelayRtc : public RTC::DataFlowComponentBase {
  public:
    explicit RelayRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), relay_port_("relay"), onward_port_("onward") {}

    RTC::ReturnCode_t onInitialize() override {
        bindParameter("work", work_, "");
        relay_port_.registerProvider("relay", "TestRelay::Relay", service_);
        onward_port_.registerConsumer("onward", "TestRelay::Relay", onward_);
        addPort(relay_port_);
        addPort(onward_port_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        end_.start(work_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        end_.stop();
        return RTC::RTC_OK;
    }

  private:
    Bytes echo(const Bytes& bytes) {
        TestRelay::Bytes sent;
        sent.length(static_cast<CORBA::ULong>(bytes.size()));
        std::copy(bytes.begin(), bytes.end(), sent.get_buffer());
        const TestRelay::Bytes_var back = onward_->echo(sent);
        return {back->get_buffer(), back->get_buffer() + back->length()};
    }
    std::string work_;
    RTC::CorbaPort relay_port_, onward_port_;
    RTC::CorbaConsumer<TestRelay::Relay> onward_;
    RelayEnd end_{{[this](const Bytes& bytes) { return call([&] { return echo(bytes); }); },
                   [this](int depth) { return call([&] { return onward_->deep(depth); }); },
                   [this](int number) { call([&] { onward_->note(number); }); }}};
    RelayService service_{end_};
};

extern "C" void RelayRtcInit(RTC::Manager* manager) { register_rtc<RelayRtc>(manager, "RelayRtc"); }

// SPDX-License-Identifier: Apache-2.0
// The RT-Component of the bridge's measurement: answers each ping at once (ping.hpp).
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include "apps/bench/tandem/bridge/ping.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

using namespace tandem::bench;

class BenchPong : public RTC::DataFlowComponentBase {
  public:
    explicit BenchPong(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), pingIn_("ping", ping_), pongOut_("pong", pong_) {}

    RTC::ReturnCode_t onInitialize() override {
        // The tick counter is the same in all processes, but its rate is measured in each.
        Clock::calibrate();
        addInPort("ping", pingIn_);
        addOutPort("pong", pongOut_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        server_.answer_for_a_slice(*this);
        return RTC::RTC_OK;
    }

    // The Port that ping.hpp asks for.
    void send(const PingMessage& message) {
        pong_.data.length(message.size());
        std::copy(message.begin(), message.end(), pong_.data.get_buffer());
        pongOut_.write();
    }
    bool receive(PingMessage& message) {
        // Two calls, as RTCs are written.
        if (!pingIn_.isNew()) return false;
        pingIn_.read();
        if (ping_.data.length() != message.size()) return false;
        std::copy_n(ping_.data.get_buffer(), message.size(), message.begin());
        return true;
    }

  private:
    RTC::TimedDoubleSeq ping_, pong_;
    RTC::InPort<RTC::TimedDoubleSeq> pingIn_;
    RTC::OutPort<RTC::TimedDoubleSeq> pongOut_;
    PingServer server_;
};

/// Sixteen ports through which nothing goes.
class BenchIdle : public RTC::DataFlowComponentBase {
  public:
    explicit BenchIdle(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        for (int i = 0; i < 16; ++i) {
            ports_.push_back(std::make_unique<RTC::InPort<RTC::TimedDoubleSeq>>(
                ("in" + std::to_string(i)).c_str(), value_));
            addInPort(ports_.back()->name(), *ports_.back());
        }
        return RTC::RTC_OK;
    }

  private:
    RTC::TimedDoubleSeq value_;
    std::vector<std::unique_ptr<RTC::InPort<RTC::TimedDoubleSeq>>> ports_;
};

extern "C" void BenchPongInit(RTC::Manager* manager) {
    // Manager::load() calls this function, whose name is that of the library with "Init" behind it.
    coil::Properties profile;
    profile.setProperty("implementation_id", "BenchPong");
    profile.setProperty("type_name", "BenchPong");
    profile.setProperty("category", "bench");
    manager->registerFactory(profile, RTC::Create<BenchPong>, RTC::Delete<BenchPong>);
    profile.setProperty("implementation_id", "BenchIdle");
    profile.setProperty("type_name", "BenchIdle");
    manager->registerFactory(profile, RTC::Create<BenchIdle>, RTC::Delete<BenchIdle>);
}

// SPDX-License-Identifier: Apache-2.0
// Told to go, sends fifty numbers to another one in its host and tells it to go, prints what its ports have, and sends fifty numbers
// across the link.
#include "register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <iostream>
#include <list>
#include <string>
#include <syncstream>

class QueueRtc : public RTC::DataFlowComponentBase {
  public:
    explicit QueueRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("go", goIn_);
        for (const char* name : {"plain", "one", "four", "four_refusing", "four_without_readback"})
            addInPort(name, inputs_.emplace_back(name).port);
        for (auto* out : {&out_, &soleOut_, &localOut_, &nextOut_, &doneOut_}) addOutPort(out->name(), *out);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (!goIn_.isNew()) return RTC::RTC_OK;
        goIn_.read();
        send(localOut_);
        nextOut_.write();
        for (auto& input : inputs_) print(input);
        send(out_);
        send(soleOut_);
        doneOut_.write();
        return RTC::RTC_OK;
    }

  private:
    struct Input {
        explicit Input(const char* name) : port(name, value) {}
        RTC::TimedLong value{};
        RTC::InPort<RTC::TimedLong> port;
    };
    void send(RTC::OutPort<RTC::TimedLong>& out) {
        for (sent_.data = 1; sent_.data <= 50; ++sent_.data) out.write();
    }
    /// The numbers, and what a read without a new one gives: the port's policy for an empty buffer.
    void print(Input& input) {
        std::string line = std::string(getInstanceName()) + "." + input.port.name() + ":";
        while (input.port.isNew() && input.port.read()) line += " " + std::to_string(input.value.data);
        input.value.data = -1;
        line += input.port.read() ? ", then " + std::to_string(input.value.data) : ", then none";
        std::osyncstream(std::cout) << line << "." << std::endl;
    }

    std::list<Input> inputs_;
    RTC::TimedLong go_{}, sent_{};
    RTC::InPort<RTC::TimedLong> goIn_{"go", go_};
    RTC::OutPort<RTC::TimedLong> out_{"out", sent_}, soleOut_{"sole", sent_}, localOut_{"local", sent_},
        nextOut_{"next", sent_}, doneOut_{"done", sent_};
};

extern "C" void QueueRtcInit(RTC::Manager* manager) { register_rtc<QueueRtc>(manager, "QueueRtc"); }

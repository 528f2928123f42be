// SPDX-License-Identifier: Apache-2.0
// Asks a dictionary in each cycle until it has an answer, then once about a word that it does not have.
#include "DictionaryStub.h"
#include "register_rtc.hpp"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

#include <iostream>
#include <syncstream>

class ClerkRtc : public RTC::DataFlowComponentBase {
  public:
    explicit ClerkRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager), port_("books") {}

    RTC::ReturnCode_t onInitialize() override {
        port_.registerConsumer("dictionary", "TestDictionary::Dictionary", dictionary_);
        addPort(port_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (done_) return RTC::RTC_OK;
        TestDictionary::Weights weights;
        weights.length(2);
        weights[0] = 1.5;
        weights[1] = 2.5;
        try {
            TestDictionary::Numbers_var pages = dictionary_->pages("hello", weights);
            std::osyncstream(std::cout)
                << "clerk: " << pages->length() << " pages, the last is " << pages[1] << std::endl;
            done_ = true;
            dictionary_->pages("unknown", weights);
        } catch (const CORBA::SystemException& error) {
            if (done_) std::osyncstream(std::cout) << "clerk: " << error._name() << std::endl;
        }
        return RTC::RTC_OK;
    }

  private:
    bool done_ = false;
    RTC::CorbaPort port_;
    RTC::CorbaConsumer<TestDictionary::Dictionary> dictionary_;
};

extern "C" void ClerkRtcInit(RTC::Manager* manager) { register_rtc<ClerkRtc>(manager, "ClerkRtc"); }

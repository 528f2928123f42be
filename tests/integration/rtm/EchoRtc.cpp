// SPDX-License-Identifier: Apache-2.0
// Sends back each word that it receives, and provides a dictionary.
#include "DictionarySkel.h"
#include "register_rtc.hpp"

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <chrono>
#include <string>
#include <thread>

namespace {

class DictionaryService : public POA_TestDictionary::Dictionary,
                          public virtual PortableServer::RefCountServantBase {
  public:
    TestDictionary::Numbers* pages(const char* word, const TestDictionary::Weights& weights) override {
        if (std::string(word) == "unknown") throw TestDictionary::NotFound(word);
        auto* pages = new TestDictionary::Numbers;
        pages->length(2);
        (*pages)[0] = static_cast<CORBA::Long>(weights.length());
        (*pages)[1] = static_cast<CORBA::Long>(2 * weights[weights.length() - 1]);
        return pages;
    }
};

} // namespace

class EchoRtc : public RTC::DataFlowComponentBase {
  public:
    explicit EchoRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), wordIn_("word", word_), numbersIn_("numbers", numbers_),
          replyOut_("reply", reply_), pictureIn_("picture", picture_), pictureOut_("pictureBack", picture_),
          dictionaryPort_("dictionary") {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("word", wordIn_);
        addInPort("numbers", numbersIn_);
        addOutPort("reply", replyOut_);
        addInPort("picture", pictureIn_);
        addOutPort("pictureBack", pictureOut_);
        dictionaryPort_.registerProvider("dictionary", "TestDictionary::Dictionary", dictionary_);
        addPort(dictionaryPort_);
        return RTC::RTC_OK;
    }
    // Behaves like a device that opens and closes slowly: the property `slow_ms`.
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return take_time(); }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return take_time(); }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (wordIn_.isNew()) {
            wordIn_.read();
            reply_.tm = word_.tm;
            reply_.data =
                CORBA::string_dup((std::string(word_.data) + (word_.tm.sec ? " at a time" : "")).c_str());
            replyOut_.write();
        }
        while (pictureIn_.isNew()) {
            pictureIn_.read();
            pictureOut_.write();
        }
        return RTC::RTC_OK;
    }

  private:
    RTC::ReturnCode_t take_time() {
        std::this_thread::sleep_for(
            std::chrono::milliseconds(std::stol(getProperties().getProperty("slow_ms", "0"))));
        return RTC::RTC_OK;
    }

    RTC::TimedString word_, reply_;
    RTC::TimedDoubleSeq numbers_;
    RTC::InPort<RTC::TimedString> wordIn_;
    RTC::InPort<RTC::TimedDoubleSeq> numbersIn_;
    RTC::OutPort<RTC::TimedString> replyOut_;
    RTC::TimedOctetSeq picture_;
    RTC::InPort<RTC::TimedOctetSeq> pictureIn_;
    RTC::OutPort<RTC::TimedOctetSeq> pictureOut_;
    RTC::CorbaPort dictionaryPort_;
    DictionaryService dictionary_;
};

extern "C" void EchoRtcInit(RTC::Manager* manager) { register_rtc<EchoRtc>(manager, "EchoRtc"); }

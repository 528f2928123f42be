// SPDX-License-Identifier: Apache-2.0
// Does nothing by itself: provides a dictionary, and sends each word that it is asked about.
#include "DictionarySkel.h"
#include "register_rtc.hpp"

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <mutex>

namespace {

class SpokenDictionary : public POA_TestDictionary::Dictionary,
                         public virtual PortableServer::RefCountServantBase {
  public:
    explicit SpokenDictionary(RTC::TimedString& reply, RTC::OutPort<RTC::TimedString>& port)
        : reply_(reply), port_(port) {}
    TestDictionary::Numbers* pages(const char* word, const TestDictionary::Weights& weights) override {
        const std::lock_guard<std::mutex> lock(mutex_);
        reply_.data = CORBA::string_dup(word);
        port_.write();
        auto* pages = new TestDictionary::Numbers;
        pages->length(1);
        (*pages)[0] = static_cast<CORBA::Long>(2 * weights[0]);
        return pages;
    }

  private:
    std::mutex mutex_;
    RTC::TimedString& reply_;
    RTC::OutPort<RTC::TimedString>& port_;
};

} // namespace

class WaitRtc : public RTC::DataFlowComponentBase {
  public:
    explicit WaitRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), replyOut_("reply", reply_), dictionary_(reply_, replyOut_),
          dictionaryPort_("dictionary") {}

    RTC::ReturnCode_t onInitialize() override {
        addOutPort("reply", replyOut_);
        dictionaryPort_.registerProvider("dictionary", "TestDictionary::Dictionary", dictionary_);
        addPort(dictionaryPort_);
        return RTC::RTC_OK;
    }

  private:
    RTC::TimedString reply_;
    RTC::OutPort<RTC::TimedString> replyOut_;
    SpokenDictionary dictionary_;
    RTC::CorbaPort dictionaryPort_;
};

extern "C" void WaitRtcInit(RTC::Manager* manager) { register_rtc<WaitRtc>(manager, "WaitRtc"); }

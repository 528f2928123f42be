// SPDX-License-Identifier: Apache-2.0
// Never reads its port in a cycle: a listener prints each word when it comes, and throws if the property `throws` is given,
// another one counts what is stored.
#include "register_rtc.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <atomic>
#include <iostream>
#include <string>
#include <syncstream>

namespace {

class WordListener : public RTC::ConnectorDataListenerT<RTC::TimedString> {
  public:
    USE_CONNLISTENER_STATUS;
    WordListener(std::atomic<int>& stored, bool throws) : stored_(stored), throws_(throws) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedString& word) override {
        const std::string text = word.data.in();
        std::osyncstream(std::cout) << "heard: " + text + (word.tm.sec ? " at a time" : "") +
                                           ", stored before: " + std::to_string(stored_.load()) + "\n"
                                    << std::flush;
        if (throws_) throw CORBA::BAD_PARAM();
        return NO_CHANGE;
    }

  private:
    std::atomic<int>& stored_;
    const bool throws_;
};

class StoreListener : public RTC::ConnectorDataListener {
  public:
    USE_CONNLISTENER_STATUS;
    explicit StoreListener(std::atomic<int>& stored) : stored_(stored) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData&, const std::string&) override {
        ++stored_;
        return NO_CHANGE;
    }

  private:
    std::atomic<int>& stored_;
};

} // namespace

class ListenRtc : public RTC::DataFlowComponentBase {
  public:
    explicit ListenRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager), wordIn_("word", word_) {}

    RTC::ReturnCode_t onInitialize() override {
        wordIn_.addConnectorDataListener(
            RTC::ON_RECEIVED, new WordListener(stored_, !m_properties.getProperty("throws").empty()));
        wordIn_.addConnectorDataListener(RTC::ON_BUFFER_WRITE, new StoreListener(stored_));
        addInPort("word", wordIn_);
        return RTC::RTC_OK;
    }
    // Its last reads, after the cycles, see what the port has kept.
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        int kept = 0;
        for (; wordIn_.isNew(); ++kept) wordIn_.read();
        std::osyncstream(std::cout) << "kept: " + std::to_string(kept) + "\n" << std::flush;
        return RTC::RTC_OK;
    }

  private:
    std::atomic<int> stored_{0};
    RTC::TimedString word_;
    RTC::InPort<RTC::TimedString> wordIn_;
};

extern "C" void ListenRtcInit(RTC::Manager* manager) { register_rtc<ListenRtc>(manager, "ListenRtc"); }

// SPDX-License-Identifier: Apache-2.0
// Adds event ports and service ports when its configuration parameter `stage` becomes `add`, and removes them at `remove`. At
// `index` the service ports have another interface.
// Answers each alarm, prints each event of its state machine, and calls the provider of its books.
#include "AlarmSkel.h"
#include "DictionarySkel.h"
#include "DictionaryStub.h"
#include "register_rtc.hpp"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/EventPort.h>
#include <rtm/StaticFSM.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <mutex>
#include <string>
#include <syncstream>
#include <thread>

namespace guest {

void say(const std::string& text) { std::osyncstream(std::cout) << "guest: " + text + "\n" << std::flush; }

FSM_TOPSTATE(Top) {
    FSM_STATE(Top);
    virtual void knock() { say("knock"); }
    virtual void wait(RTC::TimedLong minutes) { say("wait " + std::to_string(minutes.data)); }

  private:
    RTC::ReturnCode_t onInit() override { return RTC::RTC_OK; }
};

class Dictionary : public POA_TestDictionary::Dictionary, public virtual PortableServer::RefCountServantBase {
  public:
    TestDictionary::Numbers* pages(const char*, const TestDictionary::Weights& weights) override {
        auto* pages = new TestDictionary::Numbers;
        pages->length(1);
        (*pages)[0] = static_cast<CORBA::Long>(weights.length());
        return pages;
    }
};

/// Its pages are negative.
class Index : public POA_TestDictionary::Index, public virtual PortableServer::RefCountServantBase {
  public:
    TestDictionary::Numbers* pages(const char*, const TestDictionary::Weights& weights) override {
        auto* pages = new TestDictionary::Numbers;
        pages->length(1);
        (*pages)[0] = -static_cast<CORBA::Long>(weights.length());
        return pages;
    }
    CORBA::Long size() override { return 1; }
};

class StageListener final : public RTC::ConfigurationSetListener {
  public:
    explicit StageListener(std::function<void(const std::string&)> enter) : enter_(std::move(enter)) {}
    void operator()(const coil::Properties& set) override { enter_(set.getProperty("stage")); }

  private:
    const std::function<void(const std::string&)> enter_;
};

} // namespace guest

class GuestRtc : public RTC::DataFlowComponentBase {
  public:
    using Machine = RTC::Machine<guest::Top>;
    explicit GuestRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), fsm_(this), raisedIn_("raised", raised_),
          answerOut_("answer", answer_), door_("door", fsm_), dictionaryPort_("dictionary"),
          booksPort_("books"), indexPort_("dictionary"), indexesPort_("books") {}

    RTC::ReturnCode_t onInitialize() override {
        dictionaryPort_.registerProvider("dictionary", "TestDictionary::Dictionary", dictionary_);
        booksPort_.registerConsumer("books", "TestDictionary::Dictionary", books_);
        indexPort_.registerProvider("dictionary", "TestDictionary::Index", index_);
        indexesPort_.registerConsumer("books", "TestDictionary::Index", indexes_);
        bindParameter("stage", stage_, "none");
        addConfigurationSetListener(
            RTC::ON_SET_CONFIG_SET,
            new guest::StageListener([this](const std::string& stage) { enter(stage); }));
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        const std::lock_guard lock(mutex_);
        while (raisedIn_.isNew()) {
            raisedIn_.read();
            answer_ = raised_;
            answer_.id = CORBA::string_dup((std::string("answer to ") + raised_.id.in()).c_str());
            answerOut_.write();
        }
        fsm_.run_event();
        if (has_books_) ask(books_, "pages");
        if (has_index_) ask(indexes_, "pages by index");
        return RTC::RTC_OK;
    }

  private:
    void enter(const std::string& stage) {
        const std::lock_guard lock(mutex_);
        if (stage == "add") {
            addInPort("raised", raisedIn_);
            addOutPort("answer", answerOut_);
            addInPort("door", door_);
            if (!is_bound_) {
                std::this_thread::sleep_for(
                    std::chrono::milliseconds(15)); // so that an access that comes too early fails
                door_.bindEvent("knock", &guest::Top::knock);
                door_.bindEvent("wait", &guest::Top::wait);
                is_bound_ = true;
            }
            addPort(dictionaryPort_);
            dictionaryPort_
                .activateInterfaces(); // the activation, which does that for earlier ports, is over
            addPort(booksPort_);
            has_books_ = true;
        } else if (stage == "index") {
            addPort(indexPort_);
            indexPort_.activateInterfaces();
            addPort(indexesPort_);
            has_index_ = true;
        } else if (stage == "remove index") {
            has_index_ = false;
            removePort(indexesPort_);
            removePort(indexPort_);
        } else if (stage == "remove") {
            has_books_ = false;
            removePort(booksPort_);
            removePort(dictionaryPort_);
            removeInPort(door_);
            removeOutPort(answerOut_);
            removeInPort(raisedIn_);
        }
    }
    template <class Interface>
    static void ask(RTC::CorbaConsumer<Interface>& books, const std::string& what) {
        TestDictionary::Weights weights;
        weights.length(3);
        for (CORBA::ULong i = 0; i < 3; ++i) weights[i] = i;
        try {
            if (CORBA::is_nil(books._ptr())) return;
            TestDictionary::Numbers_var pages = books->pages("hello", weights);
            guest::say(std::to_string(pages[0]) + " " + what);
        } catch (const CORBA::SystemException&) { // no component provides them now
        }
    }

    std::mutex mutex_; // of what enter() changes
    std::string stage_;
    bool has_books_ = false, has_index_ = false, is_bound_ = false;
    Machine fsm_;
    TestAlarm::TimedAlarm raised_{}, answer_{};
    RTC::InPort<TestAlarm::TimedAlarm> raisedIn_;
    RTC::OutPort<TestAlarm::TimedAlarm> answerOut_;
    RTC::EventInPort<Machine> door_;
    RTC::CorbaPort dictionaryPort_, booksPort_, indexPort_, indexesPort_;
    guest::Dictionary dictionary_;
    guest::Index index_;
    RTC::CorbaConsumer<TestDictionary::Dictionary> books_;
    RTC::CorbaConsumer<TestDictionary::Index> indexes_;
};

extern "C" void GuestRtcInit(RTC::Manager* manager) { register_rtc<GuestRtc>(manager, "GuestRtc"); }

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "TalkSkel.h"
#include <chrono>
#include <mutex>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <stdexcept>
#include <thread>

namespace testing {

class TalkServant : public POA_Testing::Talk {
  public:
    char* repeat(const char* text) override { return CORBA::string_dup(text); }
    CORBA::WChar* repeat_wide(const CORBA::WChar* text) override { return CORBA::wstring_dup(text); }
    CORBA::Any* repeat_any(const CORBA::Any& value) override { return new CORBA::Any(value); }
    Testing::Bytes* repeat_bytes(const Testing::Bytes& value) override { return new Testing::Bytes(value); }
    void refuse(const char* reason) override { throw Testing::Refused(reason, 7); }
    void refuse_wide(CORBA::ULong character) override {
        const CORBA::WChar reason[] = {static_cast<CORBA::WChar>(character), 0};
        throw Testing::WideRefused(reason);
    }
    void fail_undeclared() override { throw Testing::Refused("undeclared", 8); }
    void fail_with_system_exception() override { throw CORBA::BAD_INV_ORDER(42, CORBA::COMPLETED_YES); }
    void fail_with_other_exception() override { throw std::runtime_error("as told"); }
    void note(CORBA::Long number, CORBA::Long after_ms) override {
        std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
        const std::lock_guard lock(mutex_);
        CORBA_SeqUtil::push_back(noted_, number);
    }
    Testing::Longs* noted() override {
        const std::lock_guard lock(mutex_);
        return new Testing::Longs(noted_);
    }
    void tell(Testing::Listener_ptr whom) override { whom->heard(0); }
    CORBA::Object_ptr repeat_object(CORBA::Object_ptr value) override {
        return CORBA::Object::_duplicate(value);
    }
    CORBA::Long call_back(Testing::Listener_ptr whom, CORBA::Long depth) override {
        return depth == 0 ? 0 : whom->heard(depth) + 1;
    }
    void wait_for(CORBA::Long ms) override { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

  private:
    std::mutex mutex_;
    Testing::Longs noted_;
};

/// Provides the service Testing::Talk on the port `talk`.
class Talker : public RTC::DataFlowComponentBase {
  public:
    explicit Talker(RTC::Manager* manager) : DataFlowComponentBase(manager), port_("talk") {}
    RTC::ReturnCode_t onInitialize() override {
        port_.registerProvider("talk", "Testing::Talk", servant_);
        addPort(port_);
        return RTC::RTC_OK;
    }

  private:
    RTC::CorbaPort port_;
    TalkServant servant_;
};

/// Uses a Testing::Talk through the port `talk`.
class TalkClient : public RTC::DataFlowComponentBase {
  public:
    explicit TalkClient(RTC::Manager* manager) : DataFlowComponentBase(manager), port_("talk") {}
    RTC::ReturnCode_t onInitialize() override {
        port_.registerConsumer("talk", "Testing::Talk", talk_);
        addPort(port_);
        return RTC::RTC_OK;
    }
    RTC::CorbaPort port_;
    RTC::CorbaConsumer<Testing::Talk> talk_;
};

} // namespace testing

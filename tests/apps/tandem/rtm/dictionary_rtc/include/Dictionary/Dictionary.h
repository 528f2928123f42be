// SPDX-License-Identifier: Apache-2.0
#ifndef DICTIONARY_H
#define DICTIONARY_H
#include <rtm/idl/BasicDataTypeSkel.h>

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

#include "CounterSkel.h"

// With an exception specification, as they were written before C++17.
class CounterSVC_impl : public virtual POA_Counter, public virtual PortableServer::RefCountServantBase {
  public:
    CounterSVC_impl() : m_count(0) {}
    RTC::TimedString* look_up(const char* word) throw(CORBA::SystemException);
    RTC::TimedLong count() throw(CORBA::SystemException);

  private:
    int m_count;
};

// Provides the service that it requires, and looks up a word when it is activated.
class Dictionary : public RTC::DataFlowComponentBase {
  public:
    Dictionary(RTC::Manager* manager);
    virtual RTC::ReturnCode_t onInitialize();
    virtual RTC::ReturnCode_t onExecute(RTC::UniqueId ec_id);

  private:
    RTC::CorbaPort m_offeredPort, m_wantedPort;
    CounterSVC_impl m_counter;
    RTC::CorbaConsumer<Counter> m_other;
    bool m_asked;
};

extern "C" {
void DictionaryInit(RTC::Manager* manager);
};
#endif

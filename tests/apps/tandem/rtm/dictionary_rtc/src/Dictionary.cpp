// SPDX-License-Identifier: Apache-2.0
#include "Dictionary.h"

#include <iostream>

static const char* dictionary_spec[] = {"implementation_id",
                                        "Dictionary",
                                        "type_name",
                                        "Dictionary",
                                        "description",
                                        "words",
                                        "version",
                                        "1.0.0",
                                        "vendor",
                                        "somebody",
                                        "category",
                                        "Test",
                                        "activity_type",
                                        "PERIODIC",
                                        "kind",
                                        "DataFlowComponent",
                                        "max_instance",
                                        "1",
                                        "language",
                                        "C++",
                                        "lang_type",
                                        "compile",
                                        ""};

RTC::TimedString* CounterSVC_impl::look_up(const char* word) throw(CORBA::SystemException) {
    ++m_count;
    RTC::TimedString* found = new RTC::TimedString;
    found->tm.sec = 1;
    found->tm.nsec = 2;
    found->data = CORBA::string_dup((std::string(word) + "!").c_str());
    return found;
}

RTC::TimedLong CounterSVC_impl::count() throw(CORBA::SystemException) {
    RTC::TimedLong count;
    count.data = m_count;
    return count;
}

Dictionary::Dictionary(RTC::Manager* manager)
    : RTC::DataFlowComponentBase(manager), m_offeredPort("Offered"), m_wantedPort("Wanted"), m_asked(false) {}

RTC::ReturnCode_t Dictionary::onInitialize() {
    m_offeredPort.registerProvider("counter", "Counter", m_counter);
    m_wantedPort.registerConsumer("counter", "Counter", m_other);
    addPort(m_offeredPort);
    addPort(m_wantedPort);
    return RTC::RTC_OK;
}

RTC::ReturnCode_t Dictionary::onExecute(RTC::UniqueId) {
    if (m_asked) return RTC::RTC_OK;
    RTC::TimedString_var found = m_other->look_up("robot");
    std::cout << getInstanceName() << " found " << found->data << ", asked " << m_other->count().data
              << " time\nready" << std::endl;
    m_asked = true;
    return RTC::RTC_OK;
}

extern "C" {
void DictionaryInit(RTC::Manager* manager) {
    coil::Properties profile(dictionary_spec);
    manager->registerFactory(profile, RTC::Create<Dictionary>, RTC::Delete<Dictionary>);
}
};
